#include "host/calibration/umbmark.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace whisker::calibration {
namespace {

constexpr double kTrack = 0.14;
constexpr double kQuarter = 1.5707963267948966;

/// The ends as Borenstein and Feng's approximation for small errors has them, for squares to the left of the
/// x axis: every quarter turn is 90 degrees + alpha, and every side bends to the left by beta.
std::vector<SquareEnd> ends(double alpha, double beta, double side) {
  std::vector<SquareEnd> all;
  for (int i = 0; i < 10; ++i) {
    SquareEnd end;
    end.left = i % 2 == 0;
    const double sign = end.left ? 1 : -1;
    end.x_m = 2 * side * (alpha + sign * beta);
    end.y_m = -2 * side * (sign * alpha + beta);
    all.push_back(end);
  }
  return all;
}

TEST(Umbmark, AgreesWithTheFormulasForSmallErrors) {
  for (const double side : {1.0, 2.0}) {
    for (const double alpha : {-1e-4, 0.0, 1e-4}) {
      for (const double beta : {-1e-4, 0.0, 1e-4}) {
        const Umbmark found = umbmark(ends(alpha, beta, side), side, kTrack, 0);
        // b_actual = 90 degrees / (90 degrees + alpha) b_nominal
        EXPECT_NEAR(found.track, kQuarter / (kQuarter + alpha), 1e-6);
        // R = L / 2 / sin(beta / 2); ratio = (R + b / 2) / (R - b / 2)
        EXPECT_NEAR(found.wheel_ratio, 1 + beta * kTrack / side, 1e-6);
      }
    }
  }
}

TEST(Umbmark, PerfectSquaresChangeNothing) {
  const Umbmark found = umbmark(std::vector<SquareEnd>{{true}, {true}, {false}, {false}}, 1, kTrack);
  EXPECT_DOUBLE_EQ(found.wheel_ratio, 1);
  EXPECT_DOUBLE_EQ(found.track, 1);
  EXPECT_NEAR(found.ratio_sigma, 0, 1e-12);
}

TEST(Umbmark, RefusesTooFewSquaresAndEndsThatNothingExplains) {
  const std::vector<SquareEnd> one{{true}, {true}, {true}, {false}};
  EXPECT_THROW(umbmark(one, 1, kTrack), std::runtime_error);
  EXPECT_THROW(umbmark({}, 1, kTrack), std::runtime_error);
  std::vector<SquareEnd> far(4);
  for (std::size_t i = 0; i < 4; ++i) far[i] = {i < 2, 3, i < 2 ? 4.0 : -5.0, 0, 0};
  EXPECT_THROW(umbmark(far, 1, kTrack), std::runtime_error);
}

}  // namespace
}  // namespace whisker::calibration

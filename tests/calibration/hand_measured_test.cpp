#include "host/lab/calibration/hand_measured.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/lab/calibration/drive_procedure.hpp"
#include "host/lab/calibration/umbmark.hpp"

namespace whisker::calibration {
namespace {

std::vector<SquareEnd> read(const std::string& text) {
  std::istringstream in(text);
  return read_square_ends(in, "ends.csv");
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(HandMeasured, ReadsColumnsInAnyOrder) {
  const auto ends = read("note,y_m,side,x_m\r\nfirst,-0.02,left,0.031\r\n\n,1e-2,right,-.5\n");
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_TRUE(ends[0].left);
  EXPECT_EQ(ends[0].x_m, 0.031);
  EXPECT_EQ(ends[0].y_m, -0.02);
  EXPECT_EQ(ends[0].believed_x_m, 0);
  EXPECT_FALSE(ends[1].left);
  EXPECT_EQ(ends[1].x_m, -0.5);
  EXPECT_EQ(ends[1].y_m, 0.01);
  const auto both = read("side,x_m,y_m,believed_x_m,believed_y_m\nleft,1,2,3,4\n");
  EXPECT_EQ(both[0].believed_x_m, 3);
  EXPECT_EQ(both[0].believed_y_m, 4);
}

TEST(HandMeasured, NamesWhatIsWrongWithAFile) {
  EXPECT_EQ(refusal(""), "ends.csv:1:1: the file is empty");
  EXPECT_EQ(refusal("x_m,y_m\n"), "ends.csv:1:1: no column 'side' in the header");
  EXPECT_EQ(refusal("side,y_m\n"), "ends.csv:1:1: no column 'x_m' in the header");
  EXPECT_EQ(refusal("side,x_m\n"), "ends.csv:1:1: no column 'y_m' in the header");
  EXPECT_EQ(refusal("side,x_m,y_m\nleft,1\n"), "ends.csv:2:1: 2 fields; the header has 3");
  EXPECT_EQ(refusal("side,x_m,y_m\nup,1,2\n"), "ends.csv:2:1: 'up': the side is left or right");
  EXPECT_EQ(refusal("side,x_m,y_m\nleft,1,2\nright,1,2cm\n"), "ends.csv:3:3: '2cm' is no number");
  EXPECT_EQ(refusal("side,x_m,y_m\nleft,nan,2\n"), "ends.csv:2:2: 'nan' is no number");
  EXPECT_EQ(refusal("side,x_m,y_m\nleft,1000,2\n"), "ends.csv:2:2: 1000 m: at most 100");
}

TEST(HandMeasured, ATapeChangesCountsAndTrack) {
  Values values;
  ASSERT_TRUE(take_tape(values, Params{}, {5_m, 5050_mm}));
  EXPECT_EQ(values[Quantity::counts_per_metre].value, 4950);
  EXPECT_EQ(values[Quantity::track].value, 141414);
  EXPECT_NEAR(values[Quantity::counts_per_metre].sigma.raw(), 446, 2);
  EXPECT_EQ(robot_lines(values),
            (std::vector<std::string>{"encoder_counts_per_m = 4950", "wheel_track_m = 0.141414"}));
  EXPECT_EQ(sigma_lines(values), std::vector<std::string>{"wheel_scale_common_sigma = 0.000447"});
}

TEST(HandMeasured, SquaresKeepATrackThatIsKnownBetter) {
  const std::vector<SquareEnd> ends{{true, 0.01, 0}, {true, 0.012, 0}, {false, 0, 0.01}, {false, 0, 0.012}};
  Values values;
  values[Quantity::track] = {140500, millionths(10)};
  take_squares(ends, 1, 0.001, Params{}, values);
  EXPECT_EQ(values[Quantity::track].value, 140500);
  EXPECT_TRUE(values[Quantity::wheel_ratio].known());
  values[Quantity::track] = {140500, millionths(100000)};
  take_squares(ends, 1, 0.001, Params{}, values);
  EXPECT_NE(values[Quantity::track].value, 140500);
}

TEST(DriveProcedure, FindsTheTrueRobotAndItsLinesAreAccepted) {
  for (const char* const file : {"gyro", "reference", "hc-sr04"}) {
    Scenario s;
    apply_robot_file(s, std::string(WHISKER_SOURCE_DIR "/host/robots/") + file + ".toml");
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const WheelErrors errors = draw({}, seed);
      const Procedure done = play(s.robot, s.sensor, s.noise, errors, {}, seed);
      ASSERT_TRUE(done.complete()) << file << " " << seed;
      EXPECT_EQ(check(done.calibrated), ParamFault::none);
      for (int i = 0; i < kQuantities; ++i) {
        const auto q = static_cast<Quantity>(i);
        if (q == Quantity::gyro_scale && s.robot.gyro.fitted == Fitted::no) continue;
        ASSERT_TRUE(done.values[q].known()) << file << " " << name(q);
        const double off = done.values[q].value / best_value(s.robot, errors, done.values, q) - 1;
        EXPECT_LT(std::abs(off), q == Quantity::counts_per_metre ? 2e-3 : 1e-3)
            << file << " " << seed << " " << name(q);
        EXPECT_EQ(value_in(done.calibrated, q), done.values[q].value);
      }
    }
  }
}

TEST(DriveProcedure, IsTheSameForTheSameSeed) {
  Scenario s;
  apply_robot_file(s, WHISKER_SOURCE_DIR "/host/robots/gyro.toml");
  const WheelErrors errors = draw({}, 4);
  const auto found = [&](std::uint64_t seed) {
    return play(s.robot, s.sensor, s.noise, errors, {}, seed).values;
  };
  EXPECT_EQ(found(4), found(4));
  EXPECT_FALSE(found(4) == found(5));
}

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

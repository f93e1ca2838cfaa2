// The model of a wall against the simulator's cones.
#include "host/calibration/wall_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/scenario/bearing.hpp"
#include "host/sim/elementary.hpp"
#include "tests/calibration/sweeps.hpp"

namespace whisker::calibration {
namespace {

TEST(WallModel, PredictsTheReadingsOfACone) {
  Setting s;
  s.skew_deg = 7;
  s.beam.x_m = -0.04;
  const std::vector<Look> all = looks(swept(s), s.beam, 0);
  const Wall wall{-37 * kRadPerDeg, 12.5 * kRadPerDeg, 0.3, 62.5 * kRadPerDeg};
  Errors errors;
  errors.sigma = 1e-6;
  errors.within = s.beam.max_range_m;
  int echoes = 0;
  for (const Look& look : all) {
    const Prediction p = predict(wall, look, errors, s.beam.min_range_m);
    if (std::fabs(p.off_axis - wall.edge) < 1e-6) continue;
    EXPECT_EQ(look.metres > 0, p.visible && p.off_axis < wall.edge) << look.heading / kRadPerDeg;
    if (look.metres == 0) continue;
    EXPECT_NEAR(look.metres, p.metres, 1e-9);
    ++echoes;
  }
  EXPECT_NEAR(echoes, 2 * 125 * 380 / 360, 30);
}

TEST(WallModel, ReadingsBeforeTheRangeEndsAreNotExpected) {
  Look look{0.9, 0, 0, false};
  Wall wall{0, 0.1, 1.0, 1.2};
  Errors errors;
  errors.within = 1.2;
  EXPECT_FALSE(predict(wall, look, errors, 0).visible) << "1 / cos(0.8) is 1.44";
  errors.within = 1.43;
  EXPECT_TRUE(predict(wall, look, errors, 0).uncertain);
  errors.within = 2;
  EXPECT_FALSE(predict(wall, look, errors, 0).uncertain);
  EXPECT_TRUE(predict(wall, look, errors, 0).visible);
}

TEST(WallModel, GainIsLargestAtTheTruth) {
  Setting s;
  s.sigma_m = 0.01;
  const std::vector<Look> all = looks(swept(s), s.beam, 0);
  Errors errors;
  errors.sigma = 0.01;
  errors.within = 2;
  const Wall truth{-30 * kRadPerDeg, 12.5 * kRadPerDeg, 0.3, 0};
  Wall best = truth;
  const double most = gain(best, all, errors, 0.02);
  EXPECT_NEAR(best.edge / kRadPerDeg, 62.5, 0.6);
  for (const double off : {-0.1, 0.1}) {
    for (double Wall::*field : {&Wall::facing, &Wall::half_cone, &Wall::distance}) {
      Wall other = truth;
      other.*field += off;
      EXPECT_LT(gain(other, all, errors, 0.02), most);
    }
  }
}

TEST(WallModel, ALostReadingSaysNothing) {
  Setting s;
  Samples samples = swept(s);
  Errors errors;
  Wall wall{-30 * kRadPerDeg, 12.5 * kRadPerDeg, 0.3, 0};
  const double before = gain(wall, looks(samples, s.beam, 0), errors, 0.02);
  for (int i = 0; i < 100; ++i) samples.push_back({i * 0.01, Reading::lost, 0});
  EXPECT_EQ(gain(wall, looks(samples, s.beam, 0), errors, 0.02), before);
}

TEST(Wrapped, IsWithinHalfATurn) {
  EXPECT_DOUBLE_EQ(wrapped(7 * sim::kPi), sim::kPi);
  EXPECT_DOUBLE_EQ(wrapped(-sim::kPi), sim::kPi);
  EXPECT_NEAR(wrapped(6.0), 6.0 - 2 * sim::kPi, 1e-12);
}

}  // namespace
}  // namespace whisker::calibration

// What one beam's readings say, and when they say nothing.
#include "host/lab/calibration/beam_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/sim/elementary.hpp"
#include "host/lab/calibration/wall_model.hpp"
#include "tests/calibration/sweeps.hpp"

namespace whisker::calibration {
namespace {

BeamFit fit(const Setting& s, double wall_deg = 0) { return fit_beam(swept(s), s.beam, wall_deg); }

Setting noisy() {
  Setting s;
  s.sigma_m = 0.01;
  s.dropout = 0.1;
  s.phantom = 0.3;
  return s;
}

TEST(BeamFit, MeasuresWithoutNoise) {
  Setting s;
  s.skew_deg = -6;
  const BeamFit f = fit(s);
  ASSERT_EQ(f.trouble, Trouble::none);
  EXPECT_NEAR(f.axis_deg, 24, 0.1);
  EXPECT_NEAR(f.half_cone_deg, 12.5, 0.1);
  EXPECT_NEAR(f.edge_deg, 62.5, 0.3);
  EXPECT_NEAR(f.wall_m, 0.3, 0.001);
  EXPECT_FALSE(f.edge_is_bound);
  EXPECT_EQ(f.phantoms + f.dropouts + f.wild, 0);
  EXPECT_NEAR(f.turn_deg, 380, 1);
}

TEST(BeamFit, MeasuresUnderNoiseDropoutsAndPhantoms) {
  const Setting s = noisy();
  const BeamFit f = fit(s);
  ASSERT_EQ(f.trouble, Trouble::none);
  EXPECT_NEAR(f.axis_deg, 30, 0.8);
  EXPECT_NEAR(f.half_cone_deg, 12.5, 1.5);
  EXPECT_NEAR(f.edge_deg, 62.5, 0.8);
  EXPECT_NEAR(f.sigma_m, 0.01, 0.002);
  EXPECT_NEAR(f.phantoms, 0.3 * 0.9 * (761 - 265), 40);
  EXPECT_NEAR(f.dropouts, 0.1 * 265, 16);
}

TEST(BeamFit, TheHeadingOfTheWallMayBeAny) {
  Setting s;
  s.walls = {{{-20, -0.3}, {20, -0.3}}};
  const BeamFit f = fit(s, -90);
  ASSERT_EQ(f.trouble, Trouble::none);
  EXPECT_NEAR(f.axis_deg, 30, 0.2);
}

TEST(BeamFit, AnEdgeBeyondTheRangeIsABound) {
  Setting s;
  s.incidence_deg = 89;
  s.beam.max_range_m = 0.6;
  const BeamFit f = fit(s);
  ASSERT_EQ(f.trouble, Trouble::none);
  EXPECT_TRUE(f.edge_is_bound);
  EXPECT_LE(f.edge_deg, 12.5 + 65);
  EXPECT_GE(f.edge_deg, 12.5 + 50);
}

TEST(BeamFit, TellsASoftEdgeFromASharpOne) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Setting s = noisy();
    s.seed = seed;
    BeamFit f = fit(s);
    EXPECT_LE(f.sure_edge_deg, f.edge_deg);
    EXPECT_GT(f.sure_edge_deg, f.edge_deg - 1.5) << "seed " << seed;
    s.soft_deg = 10;
    f = fit(s);
    ASSERT_EQ(f.trouble, Trouble::none) << "seed " << seed;
    EXPECT_NEAR(f.axis_deg, 30, 2) << "seed " << seed;
    EXPECT_LT(f.sure_edge_deg, 62.5 - 3) << "seed " << seed;
    EXPECT_GT(f.sure_edge_deg, 62.5 - 12) << "seed " << seed;
  }
}

TEST(BeamFit, RefusesFewReadings) {
  Setting s;
  s.step_deg = 8;
  EXPECT_EQ(fit(s).trouble, Trouble::few_readings);
  EXPECT_EQ(fit_beam({}, s.beam, 0).trouble, Trouble::few_readings);
}

TEST(BeamFit, RefusesLessThanATurn) {
  Setting s;
  s.from_deg = -100;
  s.to_deg = 200;
  const BeamFit f = fit(s);
  EXPECT_EQ(f.trouble, Trouble::not_enough_turn);
  EXPECT_NEAR(f.turn_deg, 300, 1);
}

TEST(BeamFit, RefusesAnEmptyPlace) {
  Setting s;
  s.walls = {};
  EXPECT_EQ(fit(s).trouble, Trouble::nothing_seen);
  s.walls = {{{2.5, -20}, {2.5, 20}}};
  EXPECT_EQ(fit(s).trouble, Trouble::nothing_seen);
}

TEST(BeamFit, PhantomsAreNoWall) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Setting s = noisy();
    s.walls = {};
    s.seed = seed;
    EXPECT_EQ(fit(s).trouble, Trouble::no_wall) << "seed " << seed;
  }
}

TEST(BeamFit, RefusesACorner) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Setting s = noisy();
    s.walls.push_back({{-20, 0.32}, {20, 0.32}});
    s.seed = seed;
    EXPECT_EQ(fit(s).trouble, Trouble::second_wall) << "seed " << seed;
  }
}

TEST(BeamFit, LeavesOutAWallFarBehind) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Setting s = noisy();
    s.walls.push_back({{-1.5, -20}, {-1.5, 20}});
    s.seed = seed;
    const BeamFit f = fit(s);
    ASSERT_EQ(f.trouble, Trouble::none) << "seed " << seed;
    EXPECT_LT(f.within_m, 1.5);
    EXPECT_NEAR(f.axis_deg, 30, 1);
    EXPECT_NEAR(f.edge_deg, 62.5, 1);
  }
}

TEST(BeamFit, RefusesWhatIsTooNoisy) {
  Setting s = noisy();
  s.sigma_m = 0.08;
  const BeamFit f = fit(s);
  EXPECT_TRUE(f.trouble == Trouble::too_noisy || f.trouble == Trouble::no_wall)
      << static_cast<int>(f.trouble);
}

// The model of a wall against the simulator's cones.

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

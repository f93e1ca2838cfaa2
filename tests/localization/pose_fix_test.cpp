#include "firmware/localization/pose_fix.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace whisker::localization::pose_fix_test {
namespace {

constexpr double kTurn = 4294967296.0;

Angle degrees(double deg) {
  return Angle::from_raw(static_cast<uint32_t>(static_cast<int64_t>(deg / 360 * kTurn)));
}
double degrees(Angle a) { return 360.0 * a.wrapped() / kTurn; }

TEST(PoseFix, WeightsBothByTheirVariances) {
  const UncertainPose estimate{{{1_m, 2_m}, 90_deg}, {300_mm, 100_mm, 3_deg}};
  const UncertainPose fix{{{1100_mm, 2200_mm}, 100_deg}, {100_mm, 100_mm, 1_deg}};
  const UncertainPose mean = fused(estimate, fix);
  // Along the heading is along y: nine tenths of the fix; across it is along x: half.
  EXPECT_NEAR(mean.pose.at.y.raw(), 2180000, 100);
  EXPECT_NEAR(mean.pose.at.x.raw(), 1050000, 100);
  EXPECT_NEAR(degrees(mean.pose.heading), 99, 0.01);
  EXPECT_NEAR(mean.sigma.along.raw(), 94868, 50);
  EXPECT_NEAR(mean.sigma.across.raw(), 70711, 50);
  EXPECT_NEAR(degrees(mean.sigma.heading), 0.94868, 0.001);
}

TEST(PoseFix, AnExactFixIsTakenAndAnExactEstimateStays) {
  const UncertainPose estimate{{{1_m, 2_m}, 30_deg}, {300_mm, 100_mm, 3_deg}};
  const UncertainPose fix{{{-5_m, 7_m}, 200_deg}, {}};
  const UncertainPose taken = fused(estimate, fix);
  EXPECT_NEAR(taken.pose.at.x.raw(), -5000000, 10);
  EXPECT_NEAR(taken.pose.at.y.raw(), 7000000, 10);
  EXPECT_EQ(taken.pose.heading, fix.pose.heading);
  EXPECT_EQ(taken.sigma.along, 0_mm);
  const UncertainPose stays = fused({estimate.pose, {}}, {fix.pose, {1_m, 1_m, 5_deg}});
  EXPECT_EQ(stays.pose.at, estimate.pose.at);
  EXPECT_EQ(stays.pose.heading, estimate.pose.heading);
}

TEST(PoseFix, JumpsBeyondFourSigmasOfTheDifferenceInAnyDirection) {
  const UncertainPose estimate{{{}, 0_deg}, {30_mm, 300_mm, 3_deg}};
  const PoseSigma sigma{40_mm, 400_mm, 4_deg};  // of the difference: 50 mm, 500 mm, 5 degrees
  const auto jump = [&](Length x, Length y, Angle turn) { return jumps(estimate, {{{x, y}, turn}, sigma}); };
  EXPECT_FALSE(jump(199_mm, 0_mm, 0_deg));
  EXPECT_TRUE(jump(-201_mm, 0_mm, 0_deg));
  EXPECT_FALSE(jump(0_mm, -1999_mm, 0_deg));
  EXPECT_TRUE(jump(0_mm, 2001_mm, 0_deg));
  EXPECT_FALSE(jump(0_mm, 0_mm, -degrees(19.9)));
  EXPECT_TRUE(jump(0_mm, 0_mm, degrees(20.1)));
}

/// What a mean of two normal errors does: the result's sigma is the spread of its error.
TEST(PoseFix, TheSigmaOfTheMeanIsThatOfItsError) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const PoseSigma own{250_mm, 60_mm, 2_deg}, sigma{50_mm, 80_mm, 3_deg};
  const Angle heading = 137_deg;
  const double c = std::cos(137 * 3.14159265358979 / 180), s = std::sin(137 * 3.14159265358979 / 180);
  const auto drawn = [&](const PoseSigma& of) {
    const double along = of.along.raw() * normal(random), across = of.across.raw() * normal(random);
    return Pose{{micrometres(static_cast<int32_t>(along * c - across * s)),
                 micrometres(static_cast<int32_t>(along * s + across * c))},
                degrees(degrees(of.heading) * normal(random))};
  };
  double along = 0, across = 0, turn = 0;
  constexpr int kDraws = 4000;
  PoseSigma said;
  for (int i = 0; i < kDraws; ++i) {
    Pose estimate = drawn(own), fix = drawn(sigma);
    const double off = degrees(estimate.heading);
    // The true heading is the nominal one, so that the axes are those of the sigmas.
    estimate.heading = heading;
    fix.heading = heading + fix.heading;
    const UncertainPose mean = fused({estimate, own}, {fix, sigma});
    const double weight = 4.0 / 13;
    turn += std::pow(degrees(mean.pose.heading - heading) + off * (1 - weight), 2);
    along += std::pow(mean.pose.at.x.raw() * c + mean.pose.at.y.raw() * s, 2);
    across += std::pow(mean.pose.at.y.raw() * c - mean.pose.at.x.raw() * s, 2);
    said = mean.sigma;
  }
  const auto rms = [](double squares) { return std::sqrt(squares / kDraws); };
  EXPECT_NEAR(said.along.raw(), rms(along), 0.05 * rms(along));
  EXPECT_NEAR(said.across.raw(), rms(across), 0.05 * rms(across));
  EXPECT_NEAR(degrees(said.heading), rms(turn), 0.05 * rms(turn));
}

}  // namespace
}  // namespace whisker::localization::pose_fix_test

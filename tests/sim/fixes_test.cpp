#include "host/sim/fixes.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace whisker::sim {
namespace {

NoiseSpec fixes_every(double metres) {
  NoiseSpec noise;
  noise.fix_every_m = metres;
  noise.fix_sigma_m = 0.03;
  noise.fix_sigma_rad = 0.02;
  return noise;
}

TEST(Fixes, ComeOnceAfterEachWay) {
  Fixes fixes(fixes_every(2), 1);
  Pose fix;
  int come = 0;
  for (int i = 0; i <= 1000; ++i) come += fixes.take({}, i * 0.01, fix) ? 1 : 0;
  EXPECT_EQ(come, 5);
  EXPECT_FALSE(fixes.take({}, 10.0, fix));
}

TEST(Fixes, NoneWithoutAWay) {
  Fixes fixes(fixes_every(0), 1);
  Pose fix;
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(fixes.take({}, i, fix));
}

TEST(Fixes, AreTrueButForTheirErrors) {
  Fixes fixes(fixes_every(1), 7);
  const Pose truth{{3, -2}, 0.5};
  double x = 0, y = 0, turn = 0;
  constexpr int kFixes = 2000;
  for (int i = 1; i <= kFixes; ++i) {
    Pose fix;
    ASSERT_TRUE(fixes.take(truth, i, fix));
    x += std::pow(fix.at.x - truth.at.x, 2);
    y += std::pow(fix.at.y - truth.at.y, 2);
    turn += std::pow(fix.heading - truth.heading, 2);
  }
  EXPECT_NEAR(std::sqrt(x / kFixes), 0.03, 0.002);
  EXPECT_NEAR(std::sqrt(y / kFixes), 0.03, 0.002);
  EXPECT_NEAR(std::sqrt(turn / kFixes), 0.02, 0.0015);
}

}  // namespace
}  // namespace whisker::sim

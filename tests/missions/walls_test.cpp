// A robot that knows the direction of the walls knows its place better, and no worse where there are none.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "host/harness/run/runner.hpp"
#include "host/harness/worlds/generate.hpp"

namespace whisker {
namespace {

constexpr std::uint64_t kFirstSeed = 1700001;
constexpr int kMissions = 24;

/// Wheels of 0.2 %, declared, and no gyro.
Scenario with_walls(worlds::Kind kind, int i, Fitted straight) {
  worlds::Options options;
  options.seed = kFirstSeed + static_cast<std::uint64_t>(i);
  options.noise = true;
  options.wheel_scale_sigma = 0.002;
  Scenario s = worlds::generate(kind, options);
  s.robot.pose_error.wheel_scale = millionths(2000);
  s.robot.walls.straight = straight;
  return s;
}

double place_off(const Scenario& s) {
  double off = 0;
  RunOptions options;
  options.watch = [&](const Moment& moment) {
    const TickRecord& r = moment.record;
    off = std::hypot(r.est_x_m - r.x_m, r.est_y_m - r.y_m);
  };
  EXPECT_NE(run(s, options).verdict, Verdict::contact) << s.seed;
  return off;
}

struct Means {
  double with = 0;
  double without = 0;
};

Means means(worlds::Kind kind) {
  Means m;
  for (int i = 0; i < kMissions; ++i) {
    m.with += place_off(with_walls(kind, i, Fitted::yes)) / kMissions;
    m.without += place_off(with_walls(kind, i, Fitted::no)) / kMissions;
  }
  std::printf("off by %.3f m with walls, %.3f m without, mean of %d missions\n", m.with, m.without,
              kMissions);
  return m;
}

TEST(Walls, InMazesThePlaceIsKnownBetter) {
  const Means m = means(worlds::Kind::maze);
  EXPECT_LT(m.with, m.without / 2);
}

TEST(Walls, AmongDiscsThePlaceIsKnownNoWorse) {
  const Means m = means(worlds::Kind::discs);
  EXPECT_LT(m.with, m.without * 1.02);
}

}  // namespace
}  // namespace whisker

// A robot that knows the direction of the walls knows its heading better, and nothing changes where there are none.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "host/run/core_pilot.hpp"
#include "host/run/mission_run.hpp"
#include "host/run/runner.hpp"
#include "host/run/sim_world.hpp"
#include "host/run/spec.hpp"
#include "host/worlds/generate.hpp"

namespace whisker {
namespace {

constexpr std::uint64_t kFirstSeed = 1700001;
constexpr int kMissions = 12;

/// Wheels of 0.5 %, declared, and no gyro.
Scenario with_walls(worlds::Kind kind, int i, Fitted straight) {
  worlds::Options options;
  options.seed = kFirstSeed + static_cast<std::uint64_t>(i);
  options.noise = true;
  options.wheel_scale_sigma = 0.005;
  Scenario s = worlds::generate(kind, options);
  s.robot.pose_error.wheel_scale = millionths(5000);
  s.robot.walls.straight = straight;
  return s;
}

double place_off(const Scenario& s) {
  const SimWorld world(s);
  sim::Plant plant(world.view(), robot_spec(s), noise_spec(s.noise), s.seed, s.start);
  const auto pilot = core_pilot(s, kDefaultPlanner, plant);
  MissionRun run(s, plant, *pilot);
  for (;;) {
    run.decide();
    if (run.verdict()) break;
    run.move();
    if (run.verdict()) break;
  }
  EXPECT_NE(run.result().verdict, Verdict::contact) << s.seed;
  const Pose pose = run.status().pose;
  return std::hypot(pose.at.x.raw() * 1e-6 - plant.pose().at.x, pose.at.y.raw() * 1e-6 - plant.pose().at.y);
}

TEST(Walls, InMazesThePlaceIsKnownBetter) {
  double with = 0, without = 0;
  for (int i = 0; i < kMissions; ++i) {
    with += place_off(with_walls(worlds::Kind::maze, i, Fitted::yes)) / kMissions;
    without += place_off(with_walls(worlds::Kind::maze, i, Fitted::no)) / kMissions;
  }
  std::printf("off by %.3f m with walls, %.3f m without, mean of %d mazes\n", with, without, kMissions);
  EXPECT_LT(with, without / 2);
}

TEST(Walls, AmongDiscsNothingChanges) {
  for (int i = 0; i < kMissions; ++i) {
    const auto hash = [&](Fitted straight) { return run(with_walls(worlds::Kind::discs, i, straight)).hash; };
    EXPECT_EQ(hash(Fitted::yes), hash(Fitted::no)) << kFirstSeed + static_cast<std::uint64_t>(i);
  }
}

}  // namespace
}  // namespace whisker

// Missions with a gyro end where they say they do, and one that dies leaves wheels that it has taught.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "host/harness/run/core_pilot.hpp"
#include "host/harness/run/mission_run.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/worlds/generate.hpp"

namespace whisker {
namespace {

constexpr std::uint64_t kFirstSeed = 100500;
constexpr int kMissions = 12;

Scenario with_gyro(std::uint64_t seed) {
  Scenario s = worlds::generate(worlds::Kind::discs, {seed, 30, false, true, 0.005});
  s.robot.gyro.fitted = Fitted::yes;
  s.noise.gyro_bias_dps = 1;
  s.noise.gyro_warm_up_dps = 0.1;
  s.noise.gyro_walk_deg_per_sqrt_h = 0.4;
  s.noise.gyro_scale_sigma = 0.001;
  return s;
}

struct End {
  RunResult result;
  Health health;
  double heading_off;  ///< of the estimate, rad
};

End drive(const Scenario& s, double gyro_dies_s, bool taught = true) {
  const SimWorld world(s);
  sim::RobotSpec robot = robot_spec(s);
  robot.gyro_dies_s = gyro_dies_s;
  Scenario own = s;
  if (!taught) own.robot.gyro.fitted = Fitted::no;
  sim::Plant plant(world.view(), robot, noise_spec(s.noise), s.seed, s.start);
  const auto pilot = core_pilot(own, PlannerKind::boundary, plant);
  MissionRun run(own, plant, *pilot);
  for (;;) {
    run.decide();
    if (run.verdict()) break;
    run.move();
    if (run.verdict()) break;
  }
  const double off = radians(run.status().pose.heading) - plant.pose().heading;
  return {run.result(), run.status().health, std::fabs(std::remainder(off, 2 * sim::kPi))};
}

TEST(Gyro, MissionsEndWhereTheySayTheyDo) {
  int there = 0, there_by_wheels = 0;
  for (int i = 0; i < kMissions; ++i) {
    const Scenario s = with_gyro(kFirstSeed + static_cast<std::uint64_t>(i));
    const End end = drive(s, 1e9);
    EXPECT_EQ(end.health.gyro_lost, 0U) << s.seed;
    EXPECT_EQ(end.health.wheel_slips, 0U) << s.seed;
    there += end.result.verdict == Verdict::reached ? 1 : 0;
    there_by_wheels += drive(s, 1e9, false).result.verdict == Verdict::reached ? 1 : 0;
  }
  std::printf("%d of %d truly there with a gyro, %d by wheels alone\n", there, kMissions, there_by_wheels);
  EXPECT_GE(there, 9);
  EXPECT_LE(there_by_wheels, 3);
}

TEST(Gyro, OneThatDiesLeavesWheelsThatItHasTaught) {
  std::vector<double> taught, untaught;
  for (int i = 0; i < kMissions; ++i) {
    Scenario s = with_gyro(kFirstSeed + static_cast<std::uint64_t>(i));
    // What it has taught counts within three of these.
    s.robot.pose_error.wheel_scale = millionths(5000);
    const End end = drive(s, 15);
    EXPECT_EQ(end.health.gyro_lost, 1U) << s.seed;
    taught.push_back(end.heading_off);
    untaught.push_back(drive(s, 1e9, false).heading_off);
  }
  std::sort(taught.begin(), taught.end());
  std::sort(untaught.begin(), untaught.end());
  std::printf("median heading error %.3f rad taught, %.3f untaught\n", taught[kMissions / 2],
              untaught[kMissions / 2]);
  EXPECT_LT(taught[kMissions / 2], 0.05);
  EXPECT_LT(taught[kMissions / 2] * 4, untaught[kMissions / 2]);
}

}  // namespace
}  // namespace whisker

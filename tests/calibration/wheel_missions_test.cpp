// The missions of a calibration, driven by the whole core in the simulator.
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "host/harness/scenario/load.hpp"
#include "host/lab/calibration/drive_rig.hpp"
#include "tests/effort.hpp"

namespace whisker::calibration {
namespace {

using planning::SpinPlanner;
using planning::SquarePlanner;
using planning::StraightPlanner;

Scenario robot(const std::string& name) {
  Scenario s;
  apply_robot_file(s, WHISKER_SOURCE_DIR "/host/robots/" + name + ".toml");
  return s;
}

struct Mission {
  Mission(const std::string& name, const WheelErrors& errors, std::uint64_t seed = 1)
      : Mission(robot(name), errors, seed) {}
  Mission(const Scenario& of, const WheelErrors& errors, std::uint64_t seed = 1)
      : what(of), wrong(errors), rig(of.robot, of.sensor, of.noise, errors, seed) {}

  Ended spin(const Scenario& world) {
    spinner = std::make_unique<SpinPlanner>(what.robot);
    return rig.spin(world, *spinner);
  }
  /// Found / true.
  double share(const Values& values, Quantity q) const {
    const double counts = q == Quantity::track ? wrong.counts_per_m : 1;
    return values[q].value / (true_value(what.robot, wrong, q) * counts);
  }

  Scenario what;
  WheelErrors wrong;
  DriveRig rig;
  std::unique_ptr<SpinPlanner> spinner;
};

constexpr WheelErrors kWrong{1.02, 0.985, 1.01, 0.98};

/// Discs of 0.1 m on a circle around the robot.
Scenario ring(int discs, double distance_m) {
  Scenario world;
  for (int i = 0; i < discs; ++i) {
    const double at = 2 * sim::kPi * i / discs;
    world.discs.push_back({{distance_m * std::cos(at), distance_m * std::sin(at)}, 0.1});
  }
  return world;
}

Scenario ring_wall(double distance_m) {
  Scenario world;
  std::vector<sim::Vec2> points;
  for (int i = 0; i <= 360; ++i) {
    points.push_back({distance_m * std::cos(i * sim::kPi / 180), distance_m * std::sin(i * sim::kPi / 180)});
  }
  world.walls.push_back(points);
  return world;
}

TEST(WheelMissions, ADistanceBeyondTheRangeIsNoStructure) {
  Scenario of = robot("gyro");
  of.sensor.max_range_m = 4;
  std::string troubles[2];
  for (const Far far : {Far::clear, Far::distance}) {
    of.sensor.far_is = far;
    troubles[far == Far::distance] = Mission(of, kWrong).spin(ring(5, 2.6)).trouble;
  }
  EXPECT_NE(troubles[0], "");
  EXPECT_EQ(troubles[1], troubles[0]);
}

TEST(WheelMissions, ASpinMeasuresGyroAndTrackInEveryScene) {
  const std::uint64_t robots = test::effort(6);
  for (std::uint64_t seed = 1; seed <= robots; ++seed) {
    for (const Scene kind : {Scene::discs, Scene::wall, Scene::room}) {
      Mission mission("gyro", draw({0.02, 0.01, 0.01, 0.02}, seed), seed);
      const Ended ended = mission.spin(scene(kind, mission.what.robot, seed));
      ASSERT_EQ(ended.trouble, "") << name(kind) << " " << seed;
      EXPECT_TRUE(mission.spinner->by_gyro());
      EXPECT_LT(ended.time_s, 25);
      const Values& values = mission.spinner->values();
      for (const Quantity q : {Quantity::gyro_scale, Quantity::track}) {
        const double error = mission.share(values, q) - 1;
        EXPECT_LT(std::abs(error), 1e-3) << name(kind) << " " << seed << " " << name(q);
        EXPECT_LT(std::abs(error), 5e-6 * values[q].sigma.raw())
            << name(kind) << " " << seed << " " << name(q);
      }
      EXPECT_FALSE(values[Quantity::wheel_ratio].known());
      EXPECT_FALSE(values[Quantity::counts_per_metre].known());
    }
  }
}

TEST(WheelMissions, WithoutAGyroASpinMeasuresTheTrack) {
  for (const char* const name : {"reference", "hc-sr04", "vl53l1x"}) {
    Mission mission(name, kWrong);
    ASSERT_EQ(mission.spin(scene(Scene::room, mission.what.robot, 3)).trouble, "") << name;
    EXPECT_FALSE(mission.spinner->by_gyro());
    EXPECT_FALSE(mission.spinner->values()[Quantity::gyro_scale].known());
    EXPECT_NEAR(mission.share(mission.spinner->values(), Quantity::track), 1, 1e-3) << name;
  }
}

TEST(WheelMissions, AScaleThatIsFarOffIsFoundToo) {
  for (const double scale : {0.95, 0.97, 1.03, 1.05}) {
    Mission mission("gyro", {scale, 1, 1, 1});
    ASSERT_EQ(mission.spin(scene(Scene::discs, mission.what.robot, 5)).trouble, "") << scale;
    EXPECT_NEAR(mission.share(mission.spinner->values(), Quantity::gyro_scale), 1, 1e-3) << scale;
  }
}

TEST(WheelMissions, ASpinSaysWhyItHasNoResult) {
  const auto trouble = [](const Scenario& world) { return Mission("gyro", kWrong).spin(world).trouble; };
  EXPECT_EQ(trouble({}), "nothing_in_range");
  EXPECT_EQ(trouble(ring(12, 0.8)), "no_features");
  EXPECT_EQ(trouble(ring(8, 1.2)), "ambiguous");
  EXPECT_EQ(trouble(ring_wall(0.8)), "no_features");
}

TEST(WheelMissions, ASpinNoticesASceneThatMoves) {
  Mission mission("gyro", kWrong);
  Scenario world;
  for (int i = 0; i < 3; ++i) {
    Mover mover;
    mover.radius_m = 0.15;
    const double at = 2.1 * i;
    mover.center = {0.7 * std::cos(at), 0.7 * std::sin(at)};
    mover.path = {mover.center, {1.6 * std::cos(at + 0.9), 1.6 * std::sin(at + 0.9)}};
    mover.speed_mps = 0.11 + 0.02 * i;
    world.movers.push_back(mover);
  }
  const std::string trouble = mission.spin(world).trouble;
  EXPECT_TRUE(trouble == "scene_moved" || trouble == "ambiguous" || trouble == "blocked") << trouble;
}

TEST(WheelMissions, AGyroThatDiesOnTheWayIsNamed) {
  Mission mission("gyro", kWrong);
  mission.rig.gyro_dies(8);
  EXPECT_EQ(mission.spin(scene(Scene::room, mission.what.robot, 1)).trouble, "gyro_lost");
  StraightPlanner straight(mission.what.robot, 2_m, StraightPlanner::Way::there_and_back);
  EXPECT_EQ(mission.rig.straight(straight).trouble, "gyro_lost");
}

TEST(WheelMissions, AStraightDriveMeasuresTheRatio) {
  const std::uint64_t robots = test::effort(6);
  for (std::uint64_t seed = 1; seed <= robots; ++seed) {
    Mission mission("gyro", draw({0, 0.01, 0.001, 0}, seed), seed);
    StraightPlanner planner(mission.what.robot, 3_m, StraightPlanner::Way::there_and_back);
    const Ended ended = mission.rig.straight(planner);
    ASSERT_EQ(ended.trouble, "") << seed;
    EXPECT_LT(ended.time_s, 60);
    const Measured ratio = planner.values()[Quantity::wheel_ratio];
    const double error = mission.share(planner.values(), Quantity::wheel_ratio) - 1;
    EXPECT_LT(std::abs(error), 2e-4) << seed;
    EXPECT_LT(std::abs(error), 4e-6 * ratio.sigma.raw()) << seed;
    EXPECT_FALSE(planner.values()[Quantity::track].known());
    EXPECT_NEAR(mission.rig.distance_m(), 0, 0.05) << "back at its start";
  }
}

TEST(WheelMissions, WithoutAGyroAStraightDriveServesTheTape) {
  Mission mission("reference", kWrong);
  StraightPlanner both(mission.what.robot, 2_m, StraightPlanner::Way::there_and_back);
  EXPECT_EQ(mission.rig.straight(both).trouble, "no_gyro");
  // Equal wheels: the way is straight.
  Mission even("reference", {1, 1, 1.01, 1});
  StraightPlanner there(even.what.robot, 5_m, StraightPlanner::Way::there);
  ASSERT_EQ(even.rig.straight(there).trouble, "");
  EXPECT_NEAR(there.way().raw() * 1e-6, 5, 3e-3);
  EXPECT_NEAR(there.way().raw() * 1e-6 / even.rig.distance_m(), 1.01, 2e-4);
}

TEST(WheelMissions, SquaresToBothSidesMeasureRatioAndTrack) {
  for (const WheelErrors& wrong :
       {WheelErrors{1, 0.98, 1, 1.01}, WheelErrors{1, 1.02, 1, 0.98}, WheelErrors{}}) {
    Mission mission("reference", wrong);
    std::vector<SquareEnd> ends;
    for (int i = 0; i < 4; ++i) {
      SquareEnd end;
      end.left = i % 2 == 0;
      SquarePlanner planner(1_m, end.left ? SquarePlanner::Side::left : SquarePlanner::Side::right);
      ASSERT_EQ(mission.rig.square(planner, end).trouble, "");
      ends.push_back(end);
    }
    const Umbmark found = umbmark(ends, 1, mission.what.robot.body.track.raw() * 1e-6);
    EXPECT_NEAR(found.wheel_ratio, wrong.wheel_ratio, 1e-4);
    EXPECT_NEAR(found.track, wrong.track, 3e-4);
    EXPECT_LT(found.residual_m, 1e-3);
  }
}

TEST(WheelMissions, DrivesThatAreBlockedSaySo) {
  Scenario wall;
  wall.walls = {{{0.6, -2}, {0.6, 2}}};
  Mission mission("gyro", kWrong);
  StraightPlanner straight(mission.what.robot, 2_m, StraightPlanner::Way::there_and_back);
  EXPECT_EQ(mission.rig.straight(straight, wall).trouble, "blocked");
  SquareEnd end;
  SquarePlanner square(1_m, SquarePlanner::Side::left);
  EXPECT_EQ(mission.rig.square(square, end, wall).trouble, "blocked");
  EXPECT_EQ(square.values(), Values{});
}

// Whatever stands around the robot: no mission touches it, and each ends.
TEST(WheelMissions, NeverTouchAnythingAndAlwaysEnd) {
  const std::uint64_t worlds = test::effort(20);
  for (std::uint64_t seed = 1; seed <= worlds; ++seed) {
    const auto kind = static_cast<Scene>(seed % kScenes);
    Mission mission(seed % 2 == 0 ? "gyro" : "hc-sr04", draw({0.03, 0.02, 0.02, 0.03}, seed), seed);
    const Scenario world = scene(kind, mission.what.robot, seed + 100);
    StraightPlanner straight(mission.what.robot, 2_m, StraightPlanner::Way::there);
    SquareEnd end;
    SquarePlanner square(1_m, seed % 3 == 0 ? SquarePlanner::Side::left : SquarePlanner::Side::right);
    for (const Ended& ended : {mission.spin(world), mission.rig.straight(straight, world),
                               mission.rig.square(square, end, world)}) {
      EXPECT_NE(ended.trouble, "contact") << seed;
      EXPECT_NE(ended.trouble, "time_limit") << seed;
    }
  }
}

TEST(WheelMissions, EveryTroubleHasAName) {
  for (int i = 0; i < planning::kTroubles; ++i)
    EXPECT_STRNE(name(static_cast<planning::Trouble>(i)), "?") << i;
  EXPECT_STREQ(name(static_cast<planning::Trouble>(planning::kTroubles)), "?");
}

}  // namespace
}  // namespace whisker::calibration

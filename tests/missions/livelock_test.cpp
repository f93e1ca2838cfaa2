// Nothing goes on forever: a robot that makes no progress ends in a named fault or a verdict, and a repeated
// command changes nothing.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "host/run/pilot.hpp"
#include "host/worlds/generate.hpp"
#include "host/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/missions/bench.hpp"

namespace whisker::test {
namespace {

constexpr PlannerKind kPlannersOfTheCore[] = {PlannerKind::skirt, PlannerKind::map, PlannerKind::thesis};

Scenario open_ground(double x, double y) {
  Scenario s;
  s.start = {{0, 0}, 0};
  s.goal.at = {x, y};
  return s;
}

class Planners : public testing::TestWithParam<PlannerKind> {};
INSTANTIATE_TEST_SUITE_P(All, Planners, testing::ValuesIn(kPlannersOfTheCore),
                         [](const auto& of) { return std::string(name(of.param)); });

TEST_P(Planners, ADriveThatRefusesEverySecondCommandIsAFault) {
  Bench bench(open_ground(3, 1), GetParam());
  int commands = 0;
  bench.board().wheels = [&](hal::WheelSpeeds&) { return ++commands % 2 == 0; };
  bench.run(60);
  EXPECT_EQ(bench.ended(), "drive_refused");
  EXPECT_LT(bench.plant().time(), 1);
}

TEST_P(Planners, ADriveThatRefusesNowAndThenIsForgiven) {
  Bench bench(open_ground(2, 0.5), GetParam());
  int commands = 0;
  bench.board().wheels = [&](hal::WheelSpeeds&) { return ++commands % 40 != 0; };
  bench.run(300);
  EXPECT_EQ(bench.ended(), "reached");
}

TEST_P(Planners, ABodyThatTurnsAndNeverDrivesIsAFault) {
  Bench bench(open_ground(3, 1), GetParam());
  // Both wheels execute only the turning part of the command.
  bench.board().wheels = [](hal::WheelSpeeds& speeds) {
    const int turning = (speeds.right - speeds.left) / 2;
    speeds = {static_cast<std::int16_t>(-turning), static_cast<std::int16_t>(turning)};
    return true;
  };
  bench.run(900);
  EXPECT_TRUE(bench.ended() == "no_progress" || bench.ended() == "wheels_stalled" ||
              bench.ended() == "wheel_runaway" || bench.ended() == "gave_up")
      << bench.ended();
}

TEST_P(Planners, CoarseEncodersWithFittingTolerancesArrive) {
  worlds::Random random(7);
  for (int i = 0; i < static_cast<int>(test::effort(12)); ++i) {
    Scenario s = open_ground(random.uniform(1, 4), random.uniform(-2, 2));
    s.start.heading = random.uniform(-3, 3);
    s.robot.wheels.counts_per_metre = 100;
    s.robot.motion.drive_tolerance = 11_mm;
    s.robot.motion.turn_tolerance = 9_deg;
    ASSERT_EQ(check(s.robot), ParamFault::none);
    Bench bench(s, GetParam());
    bench.run(600);
    EXPECT_EQ(bench.ended(), "reached") << i;
  }
}

TEST_P(Planners, TheSameGoalAgainChangesNothing) {
  const Scenario s = open_ground(2, 1);
  Bench once(s, GetParam());
  Bench again(s, GetParam());
  while (once.plant().time() < 300) {
    const bool on = once.step(10);
    if (again.now_ms() % 1000 == 0) again.robot().set_goal(fixed_goal(s.goal));
    ASSERT_EQ(again.step(10), on);
    ASSERT_EQ(again.status().command.left, once.status().command.left);
    ASSERT_EQ(again.status().command.right, once.status().command.right);
    if (!on) break;
  }
  EXPECT_EQ(again.ended(), "reached");
}

}  // namespace
}  // namespace whisker::test

// Nothing goes on forever: a robot that makes no progress ends in a named fault or a verdict, and a repeated
// command changes nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "host/harness/run/pilot.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/missions/bench.hpp"

namespace whisker::test {
namespace {

constexpr PlannerKind kPlannersOfTheCore[] = {PlannerKind::boundary, PlannerKind::map, PlannerKind::thesis};

Scenario open_ground(double x, double y) {
  Scenario s;
  s.start = {{0, 0}, 0};
  s.goal.at = {x, y};
  return s;
}

Verdict verdict_of(const char* robot, worlds::Kind kind, const worlds::Options& options) {
  Scenario s = worlds::generate(kind, options);
  apply_robot_file(s, std::string(WHISKER_SOURCE_DIR) + "/host/robots/" + robot + ".toml");
  return run(s).verdict;
}

// Sensors that lose walls see the jambs of a gap too far out.
TEST(Gaps, SensorsThatLoseWallsLeadIntoNoneThatIsTooNarrow) {
  for (const std::uint64_t seed : {1900014U, 1900065U, 1900081U, 1900090U}) {
    worlds::Options options;
    options.seed = seed;
    options.discs = 50;
    EXPECT_EQ(verdict_of("hc-sr04", worlds::Kind::discs, options), Verdict::reached) << seed;
  }
}

// They show ground on a lane clear that a jamb reaches into.
TEST(Gaps, SensorsThatLoseWallsTouchNothingInThem) {
  for (const std::uint64_t seed : {95030065U, 95030121U, 95030137U}) {
    worlds::Options options;
    options.seed = seed;
    EXPECT_EQ(verdict_of("layout-40", worlds::Kind::rooms, options), Verdict::reached) << seed;
  }
}

// A body of 1 m sees 1 m of ground beyond its rim, and loses this wall again and again.
TEST(Escapes, ProveNothing) {
  Scenario s = open_ground(-35.6, 29.9);
  s.start.heading = std::atan2(29.9, -35.6);
  s.goal.tolerance_m = 1.1;
  s.robot.body.radius = 1_m;
  s.polygons.push_back({{-17.52, -0.35}, {-3.31, 17.21}, {-3.65, 17.49}, {-17.87, -0.07}});
  s.time_limit_s = 400;
  RunOptions options;
  options.planner = PlannerKind::boundary;
  const RunResult r = run(s, options);
  EXPECT_EQ(r.verdict, Verdict::gave_up) << r.detail;
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

TEST_P(Planners, CoarseEncodersArrive) {
  worlds::Random random(7);
  for (int i = 0; i < static_cast<int>(test::effort(12)); ++i) {
    Scenario s = open_ground(random.uniform(1, 4), random.uniform(-2, 2));
    s.start.heading = random.uniform(-3, 3);
    s.robot.wheels.counts_per_metre = 100;
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

// After a fault that may have lost distance, a reset discards the local grid, and the robot drives again.

Scenario ahead() {
  Scenario s;
  s.start = {{0, 0}, 0};
  s.goal.at = {6, 0};
  return s;
}

/// Brakes to rest, then gets the goal again.
void reset(Bench& bench, const Scenario& s) {
  for (int i = 0; i < 80; ++i) bench.step(10);
  bench.robot().reset();
  bench.robot().set_goal(fixed_goal(s.goal));
}

double off(Bench& bench) {
  const Vec at = bench.status().pose.at;
  return std::hypot(at.x.raw() * 1e-6 - bench.plant().pose().at.x,
                    at.y.raw() * 1e-6 - bench.plant().pose().at.y);
}

TEST(Reset, AfterAClockThatWentBackItDrivesOn) {
  const Scenario s = ahead();
  Bench bench(s, PlannerKind::boundary);
  bench.run(8);
  ASSERT_EQ(bench.ended(), "running");
  bench.set_clock(bench.now_ms() - 7000);
  bench.step(10);
  ASSERT_EQ(bench.ended(), "clock_jump");
  reset(bench, s);
  bench.run(120);
  EXPECT_EQ(bench.ended(), "reached");
}

TEST(Reset, AfterAStallOfTheCallerItKnowsWhereItIsAndTrustsNoGround) {
  const Scenario s = ahead();
  Bench bench(s, PlannerKind::boundary);
  bench.run(8);
  ASSERT_EQ(bench.ended(), "running");
  bench.pass(600);
  bench.tick();
  ASSERT_EQ(bench.ended(), "clock_jump");
  EXPECT_LT(off(bench), 0.005) << "0.18 m were driven in that time";
  bench.robot().reset();
  const double radius = s.robot.body.radius.raw() * 1e-6;
  const Pose pose = bench.status().pose;
  for (int i = 0; i < 360; ++i) {
    for (const double beyond : {0.03, 0.06, 0.1, 0.2}) {
      const double a = i * 3.14159265358979 / 180;
      const Vec at = pose.at + Vec{micrometres(static_cast<int32_t>((radius + beyond) * 1e6 * std::cos(a))),
                                   micrometres(static_cast<int32_t>((radius + beyond) * 1e6 * std::sin(a)))};
      ASSERT_FALSE(bench.local_grid()->is_clear(at)) << i << " degrees, " << beyond << " m beyond the rim";
    }
  }
}

TEST(Reset, InClutterAfterStallsOfTheCallerItTouchesNothing) {
  for (std::uint64_t seed = 1; seed <= test::effort(40); ++seed) {
    worlds::Options options;
    options.seed = 61000 + seed;
    const Scenario s = worlds::generate(worlds::Kind::discs, options);
    Bench bench(s, PlannerKind::boundary);
    for (int stall = 0; stall < 6 && !bench.plant().in_contact(); ++stall) {
      bench.run(5);
      if (bench.ended() != "running") break;
      // While the caller stalls, the wheels keep turning: a contact then is not the core's fault.
      bench.board().wheels = [](hal::WheelSpeeds&) { return true; };
      bench.plant().command({0, 0});
      bench.pass(700);
      bench.tick();
      ASSERT_EQ(bench.ended(), "clock_jump");
      reset(bench, s);
    }
    bench.run(300);
    EXPECT_NE(bench.ended(), "contact") << options.seed;
  }
}

}  // namespace
}  // namespace whisker::test

#include "firmware/safety/supervisor.hpp"

#include <gtest/gtest.h>

#include "firmware/robot.hpp"
#include "tests/robot/fake_board.hpp"

namespace whisker::safety {
namespace {

/// Seconds until a running robot that stays in one place overstays.
int longest_stay_s(const Params& params) {
  Health health;
  Supervisor supervisor(params, health);
  supervisor.configure();
  int seconds = 1;
  while (!supervisor.overstays({}, true, 1000_ms) && seconds < 1000000) ++seconds;
  EXPECT_FALSE(supervisor.faulted()) << "nothing is broken";
  EXPECT_FALSE(supervisor.overstays({}, false, 1000_ms));
  EXPECT_FALSE(supervisor.overstays({}, true, 1000_ms)) << "the next mission has as much time";
  return seconds;
}

TEST(Supervisor, OnePlaceIsLeftInMinutes) {
  EXPECT_GT(longest_stay_s({}), 60);
  EXPECT_LT(longest_stay_s({}), 600);
}

// Wheels of 0.02 m/s, 2 m apart: a full turn takes 314 s.
TEST(Supervisor, SlowWheelsFarApartHaveTheTimeToTurn) {
  Params params;
  params.body.track = 2_m;
  params.body.radius = 1_m;
  params.wheels.max_speed = 20_mm_per_s;
  EXPECT_GT(longest_stay_s(params), 20 * 314);
}

TEST(Supervisor, WhoLeavesThePlaceOrRestsIsNotCounted) {
  Health health;
  const Params params;
  Supervisor supervisor(params, health);
  supervisor.configure();
  for (int s = 0; s < 10000; ++s) EXPECT_FALSE(supervisor.overstays({}, false, 1000_ms));
  for (int s = 0; s < 10000; ++s)
    EXPECT_FALSE(supervisor.overstays({millimetres(s % 100 < 50 ? 0 : 40), {}}, true, 1000_ms));
}

/// Turns to and fro as long as there is a goal.
struct Undecided final : planning::Planner {
  void set_goal(const planning::Goal&) noexcept override { running_ = true; }
  void move_goal(Vec) noexcept override {}
  void cancel() noexcept override { running_ = false; }
  planning::Decision step(const planning::View&) noexcept override {
    planning::Decision d;
    d.outcome = running_ ? planning::Outcome::running : planning::Outcome::none;
    d.manoeuvre.kind = planning::ManoeuvreKind::cruise;
    if (running_) d.manoeuvre.turning = ++ticks_ / 120 % 2 == 0 ? 65_mm_per_s : -65_mm_per_s;
    return d;
  }

 private:
  bool running_ = false;
  int ticks_ = 0;
};

TEST(Supervisor, ARobotThatStaysInOnePlaceGivesUpAndTakesTheNextGoal) {
  const Params params;
  test::FakeBoard board;
  Undecided planner;
  Robot robot(board, board, planner, params);
  std::uint32_t now = 0;
  for (int mission = 0; mission < 2; ++mission) {
    ASSERT_TRUE(robot.set_goal({{3_m, 0_m}, 100_mm}));
    int ticks = 0;
    do {
      robot.tick(Time::from_raw(now += 10));
      board.pass();
    } while (robot.status().decision.outcome == planning::Outcome::running && ++ticks < 60000);
    EXPECT_EQ(robot.status().decision.outcome, planning::Outcome::gave_up);
    EXPECT_EQ(robot.status().decision.why, planning::Why::no_exit);
    EXPECT_EQ(robot.status().health.fault, Fault::none);
    EXPECT_NEAR(ticks, 100 * longest_stay_s(params), 200);
    for (int i = 0; i < 100; ++i) {
      robot.tick(Time::from_raw(now += 10));
      board.pass();
    }
    EXPECT_EQ(robot.status().decision.outcome, planning::Outcome::gave_up) << "it stays so";
    EXPECT_EQ(board.commanded().left, 0);
    EXPECT_EQ(board.commanded().right, 0);
  }
}

TEST(Supervisor, PressesInOnePlaceAreBounded) {
  Health health;
  const Params params;
  Supervisor supervisor(params, health);
  supervisor.configure();
  for (int i = 0; i < 30; ++i) supervisor.check_bump({millimetres(100 * (i % 5)), {}});
  EXPECT_FALSE(supervisor.faulted());
  supervisor.check_bump({});
  EXPECT_EQ(health.fault, Fault::no_progress);
  EXPECT_EQ(health.bumps, 31U);
}

TEST(Supervisor, PressesElsewhereOrInTheNextMissionCountAnew) {
  Health health;
  const Params params;
  Supervisor supervisor(params, health);
  supervisor.configure();
  for (int i = 0; i < 300; ++i) supervisor.check_bump({millimetres(100 * i), {}});
  for (int mission = 0; mission < 10; ++mission) {
    supervisor.overstays({}, false, 10_ms);
    for (int i = 0; i < 25; ++i) supervisor.check_bump({});
  }
  EXPECT_FALSE(supervisor.faulted());
}

TEST(Supervisor, TheFirstFaultStays) {
  Health health;
  const Params params;
  Supervisor supervisor(params, health);
  supervisor.configure();
  supervisor.check_ranges(derived::lost_after(params) + 1_ms);
  supervisor.check_gap({}, false);
  EXPECT_EQ(health.fault, Fault::range_lost);
  EXPECT_EQ(health.clock_jumps, 1U) << "counted all the same";
  supervisor.reset();
  EXPECT_FALSE(supervisor.faulted());
}

}  // namespace
}  // namespace whisker::safety

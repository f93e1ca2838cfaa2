#include "firmware/robot.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include <gtest/gtest.h>

#include "firmware/params/words.hpp"
#include "firmware/planning/thesis/thesis_planner.hpp"
#include "tests/robot/allocations.hpp"
#include "tests/robot/fake_board.hpp"

namespace whisker {
namespace {

class RobotTest : public testing::Test {
 protected:
  const Status& tick(int times = 1) {
    for (int i = 0; i < times; ++i) {
      now_ += 10;
      robot_.tick(Time::from_raw(now_));
      const hal::WheelSpeeds c = board_.commanded();
      peak_change_ = std::max({peak_change_, std::abs(c.left - last_.left), std::abs(c.right - last_.right)});
      last_ = c;
      board_.pass();
    }
    return robot_.status();
  }
  /// Until it drives at full speed, towards a goal 5 m ahead.
  void cruise() {
    robot_.set_goal({{5_m, 0_m}, 100_mm});
    for (int i = 0; i < 400 && board_.commanded().left < 2000; ++i) tick();
    ASSERT_GT(board_.commanded().left, 1500);
  }
  void expect_safe_stop(Fault fault, int within_ticks) {
    tick(within_ticks);
    EXPECT_EQ(robot_.status().health.fault, fault) << name(robot_.status().health.fault);
    EXPECT_EQ(robot_.status().decision.mode, planning::Mode::stopped);
    EXPECT_EQ(robot_.status().decision.why, planning::Why::fault);
    EXPECT_EQ(board_.commanded().left, 0);
    EXPECT_EQ(board_.commanded().right, 0);
  }

  Params params_;
  test::FakeBoard board_;
  planning::ThesisPlanner planner_{params_, fuzzy::kDefaultTable};
  Robot robot_{board_, board_, planner_, params_};
  std::uint32_t now_ = 0xFFFFFF00U;  // the clock wraps within the first seconds
  hal::WheelSpeeds last_{};
  int peak_change_ = 0;
};

TEST_F(RobotTest, AToleranceThatItCannotKeepIsRefusedByName) {
  const Length least = planning::smallest_tolerance(params_);
  EXPECT_EQ(least, micrometres(2286)) << "8/7 of drive_tolerance";
  for (const Length tolerance : {least - micrometres(1), 0_mm, -(1_m)}) {
    robot_.set_goal({{5_m, 0_m}, 100_mm});
    tick(100);
    EXPECT_FALSE(robot_.set_goal({{1_m, 0_m}, tolerance})) << tolerance.raw();
    tick(100);
    EXPECT_EQ(robot_.status().decision.outcome, planning::Outcome::gave_up) << "of the mission before, too";
    EXPECT_EQ(robot_.status().decision.why, planning::Why::tolerance_too_small);
    EXPECT_EQ(board_.commanded().left, 0);
  }
  EXPECT_TRUE(robot_.set_goal({{1_m, 0_m}, least}));
  EXPECT_EQ(tick().decision.outcome, planning::Outcome::running);
}

TEST_F(RobotTest, ReachesAGoalInTheOpenAndStands) {
  robot_.set_goal({{1_m, 500_mm}, 50_mm});
  int ticks = 0;
  while (tick().decision.outcome != planning::Outcome::reached && ++ticks < 5000) {
  }
  EXPECT_EQ(robot_.status().decision.mode, planning::Mode::arrived);
  EXPECT_LT(norm(robot_.status().pose.at - Vec{1_m, 500_mm}), 50_mm);
  tick(20);
  EXPECT_EQ(board_.commanded().left, 0);
  EXPECT_LE(peak_change_, 101);  // 1 m/s^2 at 10 ms is 100 units of 0.1 mm/s; rounding adds one
}

TEST_F(RobotTest, DoesNotMoveWithoutAGoal) {
  tick(200);
  EXPECT_EQ(board_.x(), 0);
  EXPECT_EQ(robot_.status().decision.mode, planning::Mode::idle);
}

TEST_F(RobotTest, ATickAllocatesNothing) {
  robot_.set_goal({{2_m, 1_m}, 50_mm});
  const std::uint64_t before = test::allocations();
  tick(1500);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_EQ(robot_.status().decision.outcome, planning::Outcome::reached);
  EXPECT_GT(before, 0U) << "the counter itself must count";
}

TEST_F(RobotTest, ReadingsThatStopComingPauseItThenStopItForGood) {
  cruise();
  board_.frozen = true;
  tick(12);
  EXPECT_EQ(robot_.status().decision.why, planning::Why::blind);
  tick(40);
  EXPECT_EQ(board_.commanded().left, 0);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
  EXPECT_EQ(robot_.status().health.range_stale, 3U);
  expect_safe_stop(Fault::range_lost, 60);
}

TEST_F(RobotTest, APauseOfTheReadingsIsTakenUpAgain) {
  cruise();
  board_.frozen = true;
  tick(60);
  const double where = board_.x();
  board_.frozen = false;
  tick(3000);
  EXPECT_EQ(robot_.status().decision.outcome, planning::Outcome::reached);
  EXPECT_GT(board_.x(), where + 1);
}

TEST_F(RobotTest, OneBeamThatOnlyGivesLostReadingsStopsItForGood) {
  cruise();
  board_.show(hal::kLeft, hal::RangeStatus::invalid);
  expect_safe_stop(Fault::range_lost, 140);
  EXPECT_GT(robot_.status().health.range_invalid, 40U);
}

TEST_F(RobotTest, RangefindersThatRefuseAreCountedAndStopIt) {
  cruise();
  board_.ranges_refuse = true;
  expect_safe_stop(Fault::range_lost, 140);
  EXPECT_EQ(robot_.status().health.range_refused, 140U);
}

TEST_F(RobotTest, ABeamWhoseReadingsNeverAgreeStopsItForGood) {
  robot_.set_goal({{5_m, 0_m}, 100_mm});
  int ticks = 0;
  while (robot_.status().health.fault == Fault::none && ticks < 600) {
    board_.show(hal::kLeft, hal::RangeStatus::ok, ticks / 2 % 2 == 0 ? 500 : 700);
    tick();
    ++ticks;
  }
  // Each of three readings may take a second before the beam counts as lost, and one more may be under way.
  EXPECT_NEAR(ticks, 400, 20);
  expect_safe_stop(Fault::range_unsteady, 1);
  EXPECT_EQ(robot_.status().health.unsteady_looks, 1U);
  tick(100);
  EXPECT_EQ(robot_.status().health.unsteady_looks, 1U);
}

TEST_F(RobotTest, ReadingsThatDisagreeWhileItRestsAreNoFault) {
  for (int i = 0; i < 1000; ++i) {
    board_.show(hal::kLeft, hal::RangeStatus::ok, i / 2 % 2 == 0 ? 500 : 700);
    tick();
  }
  robot_.set_goal({{1_m, 0_m}, 100_mm});
  tick(2);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
  tick(1200);
  EXPECT_EQ(robot_.status().decision.outcome, planning::Outcome::reached);
}

TEST_F(RobotTest, ADriveThatRefusesIsGivenZeroAndStopsItForGood) {
  cruise();
  board_.drive_refuses = true;
  tick();
  EXPECT_EQ(robot_.status().command.left, 0);
  EXPECT_EQ(robot_.status().health.drive_refused, 1U);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
  expect_safe_stop(Fault::drive_refused, 4);
  board_.drive_refuses = false;
  expect_safe_stop(Fault::drive_refused, 50);
}

TEST_F(RobotTest, ASingleRefusalIsSurvivedAndTheRampBeginsAtZero) {
  cruise();
  board_.drive_refuses = true;
  tick();
  board_.drive_refuses = false;
  peak_change_ = 0;
  last_ = {};
  tick();
  EXPECT_EQ(board_.commanded().left, 0);
  tick(3000);
  EXPECT_LE(peak_change_, 101);
  EXPECT_EQ(robot_.status().decision.outcome, planning::Outcome::reached);
}

TEST_F(RobotTest, CountsThatStayAwayStopIt) {
  cruise();
  board_.counts_refuse = true;
  tick(4);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
  expect_safe_stop(Fault::drive_refused, 60);
  EXPECT_EQ(robot_.status().health.encoder_refused, 64U);
}

TEST_F(RobotTest, WithoutCountsItBrakesAndIsNotSettled) {
  cruise();
  const hal::WheelSpeeds before = board_.commanded();
  board_.counts_refuse = true;
  tick(4);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
  EXPECT_LT(std::abs(board_.commanded().left), std::abs(before.left));
  EXPECT_LT(std::abs(board_.commanded().right), std::abs(before.right));
  board_.counts_refuse = false;
  robot_.cancel();
  tick(100);
  board_.counts_refuse = true;
  robot_.set_goal({{-(1_m), 0_m}, 100_mm});
  tick(4);
  EXPECT_EQ(robot_.status().decision.why, planning::Why::goal_set) << "nothing says that it stands";
  board_.counts_refuse = false;
  tick(2000);
  EXPECT_EQ(robot_.status().decision.outcome, planning::Outcome::reached);
}

TEST_F(RobotTest, AJumpOfTheCountsStopsIt) {
  cruise();
  board_.jump = 0.07;
  expect_safe_stop(Fault::encoder_jump, 60);
  EXPECT_EQ(robot_.status().health.encoder_jumps, 1U);
}

TEST_F(RobotTest, WheelsThatDoNotTurnStopIt) {
  board_.wheels_blocked = true;
  robot_.set_goal({{5_m, 0_m}, 100_mm});
  expect_safe_stop(Fault::wheels_stalled, 320);
  EXPECT_GE(robot_.status().health.wheel_stalls, 1U);
}

TEST_F(RobotTest, EncodersThatAreSwappedStopItInTheFirstTurn) {
  board_.swapped = true;
  robot_.set_goal({{0_m, 5_m}, 100_mm});
  expect_safe_stop(Fault::wheel_runaway, 300);
  EXPECT_EQ(robot_.status().health.wheel_runaways, 1U);
  tick(100);
  EXPECT_EQ(robot_.status().health.wheel_runaways, 1U);
}

TEST_F(RobotTest, CountsThatNeverComeToRestStopIt) {
  robot_.set_goal({{5_m, 0_m}, 100_mm});
  for (int i = 0; i < 300; ++i) {
    board_.jump = i % 2 == 0 ? 0 : 0.0002;
    tick();
  }
  expect_safe_stop(Fault::no_progress, 1);
}

TEST_F(RobotTest, AClockThatJumpsEitherWayStopsIt) {
  for (const std::uint32_t jump : {61U, 101U, 0xFFFFFFF0U, 0xFFFFFFF6U, 0x80000000U}) {
    Robot robot(board_, board_, planner_, params_);
    robot.tick(Time::from_raw(1000));
    robot.tick(Time::from_raw(1010));
    EXPECT_EQ(robot.status().health.fault, Fault::none);
    robot.tick(Time::from_raw(1010 + jump));
    EXPECT_EQ(robot.status().health.fault, Fault::clock_jump) << jump;
    EXPECT_EQ(robot.status().health.clock_jumps, 1U);
  }
}

TEST_F(RobotTest, ALateTickIsCountedAndForgiven) {
  tick(3);
  now_ += 2;
  tick();
  EXPECT_EQ(robot_.status().health.late_ticks, 0U);
  now_ += 4;
  tick();
  EXPECT_EQ(robot_.status().health.late_ticks, 1U);
  now_ += 50;
  tick();
  EXPECT_EQ(robot_.status().health.late_ticks, 2U);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
}

TEST_F(RobotTest, AnInvalidParameterSetNeverMoves) {
  Params bad;
  bad.rangefinders.rate_hz = 101;
  Robot robot(board_, board_, planner_, bad);
  robot.set_goal({{5_m, 0_m}, 100_mm});
  for (std::uint32_t t = 10; t < 5000; t += 10) {
    robot.tick(Time::from_raw(t));
    ASSERT_EQ(board_.commanded().left, 0);
    board_.pass();
  }
  EXPECT_EQ(robot.status().health.fault, Fault::invalid_params);
  EXPECT_EQ(board_.commands, 499);
  board_.drive_refuses = true;
  robot.tick(Time::from_raw(5000));
  EXPECT_EQ(robot.status().health.drive_refused, 1U);
  robot.reset();
  EXPECT_EQ(robot.status().health.fault, Fault::invalid_params);
}

/// Must not be asked.
class NoPlanner final : public planning::Planner {
 public:
  void set_goal(const planning::Goal&) noexcept override { ++asked; }
  void move_goal(Vec) noexcept override { ++asked; }
  void cancel() noexcept override {}
  planning::Decision step(const planning::View&) noexcept override {
    ++asked;
    return {};
  }
  int asked = 0;
};

TEST_F(RobotTest, WithAnInvalidParameterSetNothingIsComputed) {
  Params bad;
  for (int i = 0; i < kParams; ++i) set_raw_param(bad, i, 0x7FFFFFFF);
  NoPlanner planner;
  Robot robot(board_, board_, planner, bad, &board_, &board_);
  EXPECT_FALSE(robot.place({{1_m, 2_m}, 30_deg}));
  EXPECT_FALSE(robot.set_goal({{5_m, 0_m}, 100_mm}));
  for (std::uint32_t t = 10; t < 100; t += 10) {
    EXPECT_FALSE(robot.correct({{1_m, 2_m}, 30_deg}, {10_mm, 10_mm, 1_deg}));
    robot.braked_elsewhere();
    robot.tick(Time::from_raw(t));
    robot.cancel();
    robot.reset();
    board_.pass();
  }
  EXPECT_EQ(planner.asked, 0);
  EXPECT_EQ(board_.gyro_reads, 0);
  EXPECT_EQ(robot.status().pose.at, Vec{});
  EXPECT_EQ(robot.status().health.fault, Fault::invalid_params);
}

TEST_F(RobotTest, ResetClearsTheFaultAndANewGoalDrivesAgain) {
  cruise();
  board_.frozen = true;
  tick(150);
  board_.frozen = false;
  robot_.reset();
  tick(50);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
  EXPECT_EQ(robot_.status().decision.mode, planning::Mode::idle);
  robot_.set_goal({{6_m, 0_m}, 100_mm});
  tick(4000);
  EXPECT_EQ(robot_.status().decision.outcome, planning::Outcome::reached);
}

TEST_F(RobotTest, AGoalGivenWhileAFaultStandsIsDroppedByReset) {
  cruise();
  board_.jump = 0.07;
  tick(60);
  robot_.set_goal({{6_m, 0_m}, 100_mm});
  robot_.reset();
  tick(50);
  EXPECT_EQ(robot_.status().decision.mode, planning::Mode::idle);
  EXPECT_EQ(robot_.status().decision.why, planning::Why::cancelled);
}

TEST_F(RobotTest, ParametersThatBecomeValidLaterDoNotBringItToLife) {
  Params params;
  params.rangefinders.rate_hz = 101;
  Robot robot(board_, board_, planner_, params);
  params.rangefinders.rate_hz = 50;
  robot.reset();
  EXPECT_EQ(robot.status().health.fault, Fault::invalid_params);
}

TEST_F(RobotTest, AGoalMaySetAtAnyTickAndAnotherMayReplaceIt) {
  for (int at = 0; at < 400; at += 7) {
    test::FakeBoard board;
    planning::ThesisPlanner planner(params_, fuzzy::kDefaultTable);
    Robot robot(board, board, planner, params_);
    robot.set_goal({{3_m, 0_m}, 100_mm});
    for (int i = 0; i < 3000; ++i) {
      if (i == at) robot.set_goal({{-(500_mm), 500_mm}, 50_mm});
      robot.tick(Time::from_raw(static_cast<std::uint32_t>(10 * i)));
      board.pass();
    }
    ASSERT_EQ(robot.status().decision.outcome, planning::Outcome::reached) << at;
    ASSERT_LT(norm(robot.status().pose.at - Vec{-(500_mm), 500_mm}), 50_mm) << at;
  }
}

TEST_F(RobotTest, CancelStopsAtAnyTick) {
  for (int at = 0; at < 400; at += 7) {
    test::FakeBoard board;
    planning::ThesisPlanner planner(params_, fuzzy::kDefaultTable);
    Robot robot(board, board, planner, params_);
    robot.set_goal({{3_m, 1_m}, 100_mm});
    for (int i = 0; i < at + 60; ++i) {
      if (i == at) robot.cancel();
      robot.tick(Time::from_raw(static_cast<std::uint32_t>(10 * i)));
      board.pass();
    }
    ASSERT_EQ(robot.status().decision.mode, planning::Mode::idle) << at;
    ASSERT_EQ(robot.status().decision.why, planning::Why::cancelled) << at;
    ASSERT_EQ(board.commanded().left, 0) << at;
    ASSERT_EQ(board.commanded().right, 0) << at;
  }
}

TEST_F(RobotTest, ATurnedStartIsTakenIntoAccount) {
  robot_.place({{2_m, 2_m}, 90_deg});
  robot_.set_goal({{2_m, 3_m}, 50_mm});
  tick(1000);
  EXPECT_EQ(robot_.status().decision.outcome, planning::Outcome::reached);
  EXPECT_NEAR(board_.x(), 1.0, 0.05);
}

}  // namespace
}  // namespace whisker

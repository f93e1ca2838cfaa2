// The whole core with bump switches on a board of the test.
#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/planning/thesis/thesis_planner.hpp"
#include "firmware/robot.hpp"
#include "tests/robot/fake_board.hpp"

namespace whisker {
namespace {

constexpr std::uint8_t kFrontPressed = 1U << hal::kFront;

Params fitted() {
  Params p;
  p.bumper.fitted = Fitted::yes;
  return p;
}

class BumperTest : public testing::Test {
 protected:
  const Status& tick(int times = 1) {
    for (int i = 0; i < times; ++i) {
      now_ += 10;
      robot_.tick(Time::from_raw(now_));
      board_.pass();
    }
    return robot_.status();
  }
  bool stands() const { return board_.commanded().left == 0 && board_.commanded().right == 0; }
  bool drives_ahead() const { return std::min(board_.commanded().left, board_.commanded().right) > 1800; }
  void cruise() {
    robot_.set_goal({{5_m, 0_m}, 100_mm});
    for (int i = 0; i < 2000 && !drives_ahead(); ++i) tick();
    ASSERT_TRUE(drives_ahead());
    tick(50);
  }
  /// Until the reflex is over, at most 10 s.
  void until_over() {
    for (int i = 0; i < 1000 && robot_.status().decision.why == planning::Why::bumped; ++i) tick();
  }

  Params params_ = fitted();
  test::FakeBoard board_;
  planning::TableBoundaryPlanner planner_{params_, fuzzy::kDefaultTable};
  Robot robot_{board_, board_, planner_.planner, params_, &board_};
  std::uint32_t now_ = 0;
};

TEST_F(BumperTest, APressStopsTheWheelsAtThatVeryTick) {
  cruise();
  board_.pressed = kFrontPressed;
  const Status& status = tick();
  EXPECT_EQ(status.command.left, 0);
  EXPECT_EQ(status.command.right, 0);
  EXPECT_EQ(status.decision.why, planning::Why::bumped);
  EXPECT_EQ(status.pressed, kFrontPressed);
  EXPECT_EQ(status.health.bumps, 1U);
  EXPECT_EQ(status.health.fault, Fault::none);
}

TEST_F(BumperTest, ItBacksOffHalfItsRadiusAndDrivesOn) {
  cruise();
  const double pressed_at = board_.x();
  board_.pressed = kFrontPressed;
  tick(3);
  EXPECT_EQ(board_.x(), pressed_at) << "it stands before it backs off";
  for (int i = 0; i < 100 && board_.x() > pressed_at - 0.01; ++i) tick();
  board_.pressed = 0;
  until_over();
  EXPECT_NEAR(board_.x(), pressed_at - 0.045, 0.015);
  EXPECT_EQ(robot_.status().health.bumps, 1U);
  tick(3000);
  EXPECT_GT(board_.x(), pressed_at + 1) << "past it";
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
}

TEST_F(BumperTest, NoCommandDrivesAheadWhileItIsPressed) {
  cruise();
  board_.pressed = kFrontPressed;
  for (int i = 0; i < 300; ++i) {
    tick();
    EXPECT_LE(board_.commanded().left + board_.commanded().right, 0);
  }
}

TEST_F(BumperTest, TheThesisPlannerIsStoppedAsWell) {
  planning::ThesisPlanner thesis{params_, fuzzy::kDefaultTable};
  Robot robot{board_, board_, thesis, params_, &board_};
  robot.set_goal({{5_m, 0_m}, 100_mm});
  const auto tick = [&] {
    now_ += 10;
    robot.tick(Time::from_raw(now_));
    board_.pass();
  };
  for (int i = 0; i < 2000 && !drives_ahead(); ++i) tick();
  ASSERT_TRUE(drives_ahead());
  const double pressed_at = board_.x();
  board_.pressed = kFrontPressed;
  tick();
  EXPECT_TRUE(stands());
  for (int i = 0; i < 100; ++i) tick();
  EXPECT_LT(board_.x(), pressed_at - 0.005);
  board_.pressed = 0;
  for (int i = 0; i < 6000; ++i) tick();
  EXPECT_GT(board_.x(), pressed_at + 0.5);
}

TEST_F(BumperTest, ASwitchThatStaysPressedIsAFaultInBoundedTime) {
  cruise();
  board_.pressed = kFrontPressed;
  int ticks = 0;
  while (tick().health.fault == Fault::none && ticks < 2000) ++ticks;
  EXPECT_EQ(robot_.status().health.fault, Fault::bumper_stuck);
  EXPECT_EQ(robot_.status().health.bumper_stuck, 1U);
  EXPECT_LT(ticks, 700);
  EXPECT_TRUE(stands());
  board_.pressed = 0;
  tick(100);
  EXPECT_TRUE(stands()) << "latched";
}

TEST_F(BumperTest, ASwitchThatIsPressedFromTheStartIsAFaultAndNothingMoves) {
  board_.pressed = 1U << hal::kLeft;
  robot_.set_goal({{5_m, 0_m}, 100_mm});
  tick(1000);
  EXPECT_EQ(robot_.status().health.fault, Fault::bumper_stuck);
  EXPECT_LE(board_.x(), 0);
  EXPECT_GT(board_.x(), -0.001) << "it has covered no ground to go back on, and none behind it is clear";
}

TEST_F(BumperTest, ABumperThatGivesNoStateIsAFault) {
  cruise();
  board_.bumper_refuses = true;
  tick(4);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
  tick(40);
  EXPECT_EQ(robot_.status().health.fault, Fault::bumper_lost);
  EXPECT_EQ(robot_.status().health.bumper_refused, 44U);
  EXPECT_TRUE(stands());
}

TEST_F(BumperTest, ABumperThatIsFittedAndNotGivenIsAFault) {
  Robot robot{board_, board_, planner_.planner, params_};
  for (int i = 0; i < 5; ++i) robot.tick(Time::from_raw(10 * static_cast<std::uint32_t>(i)));
  EXPECT_EQ(robot.status().health.fault, Fault::bumper_lost);
}

TEST_F(BumperTest, WithoutAMissionAPressMovesNothingAndCountsNothing) {
  tick(100);
  board_.pressed = kFrontPressed;
  tick(1000);
  EXPECT_EQ(board_.x(), 0);
  EXPECT_EQ(robot_.status().pressed, kFrontPressed);
  EXPECT_EQ(robot_.status().health.bumps, 0U);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
}

// The same commands, whatever the switches do, if the parameter says that there are none.
TEST(WithoutABumper, ItsSwitchesChangeNothing) {
  const Params params;
  test::FakeBoard boards[2];
  planning::TableBoundaryPlanner planners[2] = {{params, fuzzy::kDefaultTable},
                                                {params, fuzzy::kDefaultTable}};
  Robot plain{boards[0], boards[0], planners[0].planner, params};
  Robot given{boards[1], boards[1], planners[1].planner, params, &boards[1]};
  for (Robot* robot : {&plain, &given}) robot->set_goal({{3_m, 1_m}, 100_mm});
  for (std::uint32_t i = 1; i < 2000; ++i) {
    boards[1].pressed = static_cast<std::uint8_t>(i / 7 % 8);
    plain.tick(Time::from_raw(10 * i));
    given.tick(Time::from_raw(10 * i));
    ASSERT_EQ(boards[0].commanded().left, boards[1].commanded().left) << i;
    ASSERT_EQ(boards[0].commanded().right, boards[1].commanded().right) << i;
    for (test::FakeBoard& board : boards) board.pass();
  }
  EXPECT_EQ(given.status().pressed, 0);
  EXPECT_EQ(given.status().health.bumps, 0U);
}

}  // namespace
}  // namespace whisker

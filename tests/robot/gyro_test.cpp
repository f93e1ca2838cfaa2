// The whole core with a gyro on a board of the test.
#include <cstdint>

#include <gtest/gtest.h>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/robot.hpp"
#include "tests/robot/fake_board.hpp"

namespace whisker {
namespace {

using localization::HeadingSource;

Params params_with_gyro() {
  Params p;
  p.gyro.fitted = Fitted::yes;
  return p;
}

class GyroTest : public testing::Test {
 protected:
  explicit GyroTest(const Params& params = params_with_gyro()) : params_(params) { board_.gyro_bias = 80; }
  const Status& tick(int times = 1) {
    for (int i = 0; i < times; ++i) {
      now_ += 10;
      robot_.tick(Time::from_raw(now_));
      board_.pass();
    }
    return robot_.status();
  }
  bool rests() const { return robot_.status().decision.why == planning::Why::gyro_rest; }
  bool stands() const { return board_.commanded().left == 0 && board_.commanded().right == 0; }
  /// Ticks until it rests, or no longer; at most a minute and a half.
  int until(bool resting) {
    int ticks = 0;
    while (rests() != resting && ticks < 9000) tick(), ++ticks;
    return ticks;
  }

  Params params_;
  test::FakeBoard board_;
  planning::TableBoundaryPlanner planner_{params_, fuzzy::kDefaultTable};
  Robot robot_{board_, board_, planner_.planner, params_, nullptr, &board_};
  std::uint32_t now_ = 0;
};

TEST_F(GyroTest, AMissionStandsForTwoSecondsFirstAndForOneAMinuteLater) {
  robot_.set_goal({{900_m, 0_m}, 100_mm});
  EXPECT_LE(until(true), 5);
  const int first = until(false);
  EXPECT_GE(first, 200);
  EXPECT_LE(first, 230);
  EXPECT_EQ(board_.x(), 0) << "not moved yet";
  EXPECT_EQ(robot_.status().heading_source, HeadingSource::gyro);

  const int driven = until(true);
  EXPECT_GE(driven, 6000);
  EXPECT_LE(driven, 7700);
  EXPECT_GT(board_.x(), 5);
  tick(60);
  EXPECT_TRUE(stands());
  EXPECT_LE(until(false), 170);
  tick(300);
  EXPECT_FALSE(stands());
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
}

TEST_F(GyroTest, AFixWithoutABoundMakesNoRestSooner) {
  robot_.set_goal({{900_m, 0_m}, 100_mm});
  until(true), until(false);
  ASSERT_TRUE(robot_.correct(robot_.status().pose, {10_mm, 10_mm, 1_deg}));
  EXPECT_GE(until(true), 6000);
}

Params params_with_bound() {
  Params p = params_with_gyro();
  p.pose_error.wheel_scale_common = Ratio::from_raw(1000);
  return p;
}

class GyroWithBoundTest : public GyroTest {
 protected:
  GyroWithBoundTest() : GyroTest(params_with_bound()) {}
};

TEST_F(GyroWithBoundTest, OnceTheHeadingMayBeOffItRestsLongerAndSooner) {
  robot_.set_goal({{900_m, 0_m}, 100_mm});
  until(true), until(false);
  EXPECT_GE(until(true), 4000) << "the first rest makes it sure for longer than half a minute";
  until(false);
  int driven = 0, rested = 0;
  for (int rest = 0; rest < 6; ++rest) driven = until(true), rested = until(false);
  EXPECT_GT(robot_.status().sigma.heading.wrapped(), Angle::turns(1, 1800).wrapped());
  EXPECT_GE(driven, 3000);
  EXPECT_LE(driven, 4700);
  EXPECT_GE(rested, 280);
  EXPECT_LE(rested, 360);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
}

TEST_F(GyroTest, StandsForNothingIfItHasStoodBeforeTheMission) {
  tick(250);
  EXPECT_EQ(robot_.status().heading_source, HeadingSource::gyro);
  robot_.set_goal({{5_m, 0_m}, 100_mm});
  for (int i = 0; i < 300; ++i) {
    tick();
    ASSERT_FALSE(rests());
  }
}

TEST_F(GyroTest, HeadingIsTheGyrosAndNotTheWheels) {
  tick(250);
  board_.gyro_turns_too_much = 1.25;
  const Angle before = robot_.status().pose.heading;
  robot_.set_goal({{0_m, 2_m}, 100_mm});
  tick(150);
  const double wheels = board_.turned();
  ASSERT_GT(wheels, 0.3);
  const double estimate = (robot_.status().pose.heading - before).wrapped() * 1.4629180792671596e-9;
  EXPECT_NEAR(estimate, 1.25 * wheels, 0.06);
}

TEST_F(GyroTest, AGyroThatIsNotThereOrDiesLeavesTheWheels) {
  board_.gyro_answers = false;
  robot_.set_goal({{1_m, 0_m}, 100_mm});
  tick(2000);
  EXPECT_EQ(robot_.status().decision.outcome, planning::Outcome::reached);
  EXPECT_EQ(robot_.status().heading_source, HeadingSource::gyro_lost);
  EXPECT_EQ(robot_.status().health.gyro_lost, 1U);

  Robot without{board_, board_, planner_.planner, params_};
  for (int i = 0; i < 20; ++i) without.tick(Time::from_raw(now_ += 10));
  EXPECT_EQ(without.status().heading_source, HeadingSource::gyro_lost);
  EXPECT_EQ(without.status().health.fault, Fault::none);
}

TEST_F(GyroTest, DrivesOnAfterFiveSecondsIfItCannotMeasureTheBias) {
  tick(250);
  robot_.set_goal({{900_m, 0_m}, 100_mm});
  tick(5000);
  ASSERT_FALSE(rests());
  board_.gyro_bias += 1000;  // as on a turntable
  until(true);
  const int waited = until(false);
  EXPECT_GE(waited, 499);
  EXPECT_LE(waited, 501);
  const double before = board_.x();
  tick(3000);
  EXPECT_NE(board_.x(), before);
  EXPECT_EQ(robot_.status().health.fault, Fault::none);
}

TEST_F(GyroTest, ResetAndCancelEndTheRest) {
  robot_.set_goal({{5_m, 0_m}, 100_mm});
  until(true);
  robot_.cancel();
  tick();
  EXPECT_FALSE(rests());
  robot_.set_goal({{5_m, 0_m}, 100_mm});
  until(true);
  robot_.reset();
  tick();
  EXPECT_FALSE(rests());
}

TEST_F(GyroTest, WithoutTheParameterTheGyroIsNotRead) {
  Params plain;
  Robot robot{board_, board_, planner_.planner, plain, nullptr, &board_};
  for (int i = 0; i < 300; ++i) robot.tick(Time::from_raw(now_ += 10));
  EXPECT_EQ(board_.gyro_reads, 0);
  EXPECT_EQ(robot.status().heading_source, HeadingSource::wheels);
}

}  // namespace
}  // namespace whisker

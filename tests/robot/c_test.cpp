#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "firmware/c/whisker.h"
#include "firmware/params/words.hpp"
#include "firmware/planning/state.hpp"
#include "tests/robot/c_board.hpp"

namespace whisker {
namespace {

/// A robot in C on a board of the tests.
struct CRobot {
  explicit CRobot(const whisker_params* wanted = nullptr, bool extras = false) {
    whisker_default_params(&params);
    if (wanted != nullptr) params = *wanted;
    const whisker_board callbacks = test::c_board(board, extras);
    created = whisker_create(&robot, &params, &callbacks);
  }
  CRobot(const CRobot&) = delete;
  CRobot& operator=(const CRobot&) = delete;

  whisker_status tick() {
    whisker_status status{};
    whisker_tick(&robot, now_ms += 10, &status);
    board.pass();
    return status;
  }
  /// Until the mission ends or the time is over.
  whisker_status drive(int seconds) {
    whisker_status status = tick();
    for (int i = 0; i < seconds * 100 && status.outcome <= WHISKER_OUTCOME_RUNNING && status.fault == 0;
         ++i) {
      status = tick();
    }
    return status;
  }

  test::FakeBoard board;
  whisker_params params{};
  whisker_robot robot{};
  uint32_t now_ms = 0;
  bool created = false;
};

TEST(C, ParametersAreThoseOfTheCore) {
  whisker_params params;
  whisker_default_params(&params);
  const Params defaults;
  for (int i = 0; i < kParams; ++i) {
    EXPECT_EQ(whisker_get_param(&params, static_cast<whisker_param>(i)), raw_param(defaults, i)) << i;
  }
  EXPECT_EQ(whisker_check_params(&params), 0);
  EXPECT_EQ(kParams, WHISKER_PARAM_SONAR + 1);
}

TEST(C, SetsParametersWithinTheirRanges) {
  whisker_params params;
  whisker_default_params(&params);
  EXPECT_TRUE(whisker_set_param(&params, WHISKER_PARAM_BODY_RADIUS, 75000));
  EXPECT_EQ(whisker_get_param(&params, WHISKER_PARAM_BODY_RADIUS), 75000U);
  EXPECT_TRUE(whisker_set_param(&params, WHISKER_PARAM_RANGE_LEFT_X, static_cast<uint32_t>(-20000)));
  const whisker_params before = params;
  EXPECT_FALSE(whisker_set_param(&params, WHISKER_PARAM_BODY_RADIUS, 19999));
  EXPECT_FALSE(whisker_set_param(&params, static_cast<whisker_param>(kParams), 1));
  EXPECT_FALSE(whisker_set_param(&params, static_cast<whisker_param>(WHISKER_PARAM_ROOM), 1));
  EXPECT_EQ(std::memcmp(&before, &params, sizeof params), 0);
  EXPECT_EQ(whisker_get_param(&params, static_cast<whisker_param>(kParams)), 0U);
}

TEST(C, NamesTheViolatedRelation) {
  whisker_params params;
  whisker_default_params(&params);
  ASSERT_TRUE(whisker_set_param(&params, WHISKER_PARAM_WHEEL_TRACK, 500000));
  EXPECT_STREQ(whisker_param_fault_name(whisker_check_params(&params)), "track_wider_than_body");
  CRobot robot{&params};
  EXPECT_TRUE(robot.created);
  EXPECT_STREQ(whisker_fault_name(robot.tick().fault), "invalid_params");
}

TEST(C, ConvertsHeadings) {
  EXPECT_EQ(whisker_heading(0), 0U);
  EXPECT_EQ(whisker_heading(90000), 0x40000000U);
  EXPECT_EQ(whisker_heading(-90000), 0xC0000000U);
  EXPECT_EQ(whisker_heading(30), Angle::turns(30, 360000).raw());
}

TEST(C, NeedsTheThreeDrivers) {
  whisker_robot room{};
  whisker_params params;
  whisker_default_params(&params);
  const whisker_board none{};
  EXPECT_FALSE(whisker_create(&room, &params, &none));
}

TEST(C, DrivesToTheGoal) {
  CRobot robot;
  ASSERT_TRUE(robot.created);
  EXPECT_EQ(robot.tick().outcome, WHISKER_OUTCOME_NONE);
  EXPECT_TRUE(whisker_place(&robot.robot, 0, 0, 0));
  EXPECT_TRUE(whisker_set_goal(&robot.robot, 1000000, 0, 50000));
  const whisker_status status = robot.drive(60);
  EXPECT_EQ(status.outcome, WHISKER_OUTCOME_REACHED);
  EXPECT_NEAR(status.x_um, 1000000, 50000);
  EXPECT_STREQ(whisker_mode_name(status.mode), "arrived");
  EXPECT_STREQ(whisker_why_name(status.why), "at_goal");
  whisker_status again{};
  whisker_get_status(&robot.robot, &again);
  EXPECT_EQ(again.x_um, status.x_um);
  whisker_tick(&robot.robot, robot.now_ms += 10, nullptr);
}

TEST(C, CancelsAMission) {
  CRobot robot;
  whisker_set_goal(&robot.robot, 1000000, 0, 50000);
  EXPECT_EQ(robot.tick().outcome, WHISKER_OUTCOME_RUNNING);
  whisker_cancel(&robot.robot);
  EXPECT_STREQ(whisker_why_name(robot.tick().why), "cancelled");
}

TEST(C, RefusesPlacesBeyondTheLimit) {
  CRobot robot;
  robot.tick();
  EXPECT_FALSE(whisker_set_goal(&robot.robot, 1000000001, 0, 50000));
  EXPECT_FALSE(whisker_set_goal(&robot.robot, 1000000, 0, 2285)) << "smaller than it keeps";
  EXPECT_FALSE(whisker_place(&robot.robot, 0, -1000000001, 0));
  EXPECT_STREQ(whisker_fault_name(robot.tick().fault), "pose_out_of_range");
  whisker_reset(&robot.robot);
  EXPECT_EQ(robot.tick().fault, 0);
}

TEST(C, StopsWhenADriverRefuses) {
  for (bool test::FakeBoard::*refuses :
       {&test::FakeBoard::ranges_refuse, &test::FakeBoard::counts_refuse, &test::FakeBoard::drive_refuses}) {
    CRobot robot;
    whisker_set_goal(&robot.robot, 1000000, 0, 50000);
    robot.tick();
    robot.board.*refuses = true;
    const whisker_status status = robot.drive(5);
    EXPECT_NE(status.fault, 0);
    EXPECT_EQ(robot.board.commanded().left, 0);
  }
}

TEST(C, TakesAFixAndDeclaresItsError) {
  whisker_params params;
  whisker_default_params(&params);
  ASSERT_TRUE(whisker_set_param(&params, WHISKER_PARAM_WHEEL_SCALE_SIGMA, 10000));
  CRobot robot{&params};
  whisker_place(&robot.robot, 0, 0, 0);
  EXPECT_TRUE(whisker_set_goal(&robot.robot, 1000000, 0, 50000));
  const whisker_status status = robot.drive(3);
  EXPECT_GT(status.sigma_along_um, 0U);
  const int32_t beside = status.y_um + 20000;
  EXPECT_TRUE(whisker_correct(&robot.robot, status.x_um, beside, status.heading, 100, 1000));
  EXPECT_NEAR(robot.tick().y_um, beside, 4000);
}

TEST(C, HasABumperAndAGyro) {
  whisker_params params;
  whisker_default_params(&params);
  ASSERT_TRUE(whisker_set_param(&params, WHISKER_PARAM_BUMPER, 1));
  ASSERT_TRUE(whisker_set_param(&params, WHISKER_PARAM_GYRO, 1));
  CRobot robot{&params, true};
  whisker_set_goal(&robot.robot, 1000000, 0, 50000);
  robot.tick();
  EXPECT_GT(robot.board.gyro_reads, 0);
  robot.board.pressed = 2;
  EXPECT_EQ(robot.tick().pressed, 2);
  robot.board.pressed = 0;
  robot.board.bumper_refuses = true;
  EXPECT_STREQ(whisker_fault_name(robot.drive(5).fault), "bumper_lost");
  CRobot without{&params};
  EXPECT_STREQ(whisker_fault_name(without.drive(5).fault), "bumper_lost");
}

}  // namespace
}  // namespace whisker

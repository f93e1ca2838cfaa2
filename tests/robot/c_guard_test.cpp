#include <string>

#include <gtest/gtest.h>

#include "firmware/guard.hpp"
#include "tests/robot/c_board.hpp"

namespace whisker {
namespace {

/// A guard in C on a board of the tests.
struct CGuard {
  explicit CGuard(const whisker_params* wanted = nullptr, bool extras = false) {
    whisker_default_params(&params);
    if (wanted != nullptr) params = *wanted;
    const whisker_board callbacks = test::c_board(board, extras);
    created = whisker_guard_create(&guard, &params, &callbacks);
  }
  CGuard(const CGuard&) = delete;
  CGuard& operator=(const CGuard&) = delete;

  whisker_guard_status tick() {
    whisker_guard_status status{};
    whisker_guard_tick(&guard, now_ms += 10, &status);
    board.pass();
    return status;
  }
  whisker_guard_status drive(std::int32_t forward, std::int32_t turning, int ticks) {
    whisker_guard_status status{};
    for (int i = 0; i < ticks; ++i) {
      whisker_guard_command(&guard, forward, turning, now_ms);
      status = tick();
    }
    return status;
  }

  test::FakeBoard board;
  whisker_params params{};
  whisker_guard guard{};
  std::uint32_t now_ms = 0;
  bool created = false;
};

TEST(CGuard, CommandsTheWheelsAsTheGuardOfCpp) {
  CGuard in_c;
  ASSERT_TRUE(in_c.created);
  whisker_guard_vouch(&in_c.guard, 350000);
  test::FakeBoard board;
  const Params params;
  Guard guard{board, board, params};
  guard.vouch(350_mm);
  for (std::uint32_t i = 1; i <= 400; ++i) {
    if (i == 200) {
      for (test::FakeBoard* b : {&board, &in_c.board}) b->show(hal::kFront, hal::RangeStatus::ok, 300);
    }
    const std::int32_t turning = i % 100 < 50 ? 800000 : -2000000;
    guard.command({250_mm_per_s, AngularRate::from_raw(turning)}, Time::from_raw((i - 1) * 10));
    const GuardStatus& wanted = guard.tick(Time::from_raw(i * 10));
    board.pass();
    const whisker_guard_status got = in_c.drive(250000, turning, 1);
    ASSERT_EQ(got.left, wanted.command.left) << i;
    ASSERT_EQ(got.right, wanted.command.right) << i;
    ASSERT_STREQ(whisker_guard_reason_name(got.reason), name(wanted.reason)) << i;
    ASSERT_EQ(got.granted_forward, wanted.forward.raw());
    ASSERT_EQ(got.granted_turning, wanted.turning.raw());
    ASSERT_EQ(got.x_um, wanted.pose.at.x.raw());
    ASSERT_EQ(got.heading, wanted.pose.heading.raw());
  }
  whisker_guard_status again{};
  whisker_guard_get_status(&in_c.guard, &again);
  EXPECT_EQ(again.asked_forward, 250000);
  EXPECT_EQ(again.asked_turning, 800000);
}

TEST(CGuard, StandsAfterTheTimeOutOfTheCommand) {
  CGuard guard;
  whisker_guard_vouch(&guard.guard, 350000);
  EXPECT_GT(guard.drive(300000, 0, 100).left, 0);
  whisker_guard_status status{};
  for (int i = 0; i < 26; ++i) status = guard.tick();
  EXPECT_STREQ(whisker_guard_reason_name(status.reason), "command_timeout");
  EXPECT_EQ(status.asked_forward, 0);
  for (int i = 0; i < 60; ++i) status = guard.tick();
  EXPECT_EQ(status.left, 0);
}

TEST(CGuard, VouchesOnlyForARadiusAboveZero) {
  whisker_params params;
  whisker_default_params(&params);
  ASSERT_TRUE(whisker_set_param(&params, WHISKER_PARAM_GUARD_NODS, 0));
  CGuard guard{&params};
  whisker_guard_vouch(&guard.guard, -350000);
  EXPECT_EQ(guard.drive(300000, 0, 50).reason, WHISKER_GUARD_UNSEEN);
}

TEST(CGuard, NamesAFaultAndEndsItByReset) {
  CGuard guard;
  guard.board.counts_refuse = true;
  whisker_guard_status status = guard.drive(300000, 0, 200);
  EXPECT_EQ(status.reason, WHISKER_GUARD_FAULT);
  EXPECT_STRNE(whisker_fault_name(status.fault), "none");
  guard.board.counts_refuse = false;
  whisker_guard_reset(&guard.guard);
  EXPECT_EQ(guard.drive(0, 0, 5).fault, 0);
  whisker_guard_tick(&guard.guard, guard.now_ms += 10, nullptr);
}

TEST(CGuard, NeedsTheThreeDriversAndFittingParameters) {
  whisker_guard room{};
  whisker_params params;
  whisker_default_params(&params);
  const whisker_board none{};
  EXPECT_FALSE(whisker_guard_create(&room, &params, &none));
  ASSERT_TRUE(whisker_set_param(&params, WHISKER_PARAM_WHEEL_TRACK, 500000));
  CGuard refused{&params};
  EXPECT_TRUE(refused.created);
  EXPECT_STREQ(whisker_fault_name(refused.drive(300000, 0, 5).fault), "invalid_params");
}

TEST(CGuard, ReadsAGyro) {
  whisker_params params;
  whisker_default_params(&params);
  ASSERT_TRUE(whisker_set_param(&params, WHISKER_PARAM_GYRO, 1));
  CGuard guard{&params, true};
  guard.drive(0, 500000, 10);
  EXPECT_GT(guard.board.gyro_reads, 0);
}

}  // namespace
}  // namespace whisker

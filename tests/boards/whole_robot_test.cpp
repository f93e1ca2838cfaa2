// Controller and base on one chip, with a simulated body, and an operator at the port to the outside.
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "firmware/apps/can/whole_robot.hpp"
#include "firmware/version.hpp"
#include "hal/boards/pico/robot_params.hpp"
#include "host/harness/bus/memory_bus.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/sim/sim_board.hpp"
#include "tests/calibration/memory_storage.hpp"

namespace whisker::can_app {
namespace {

struct Hand final : hal::Button {
  hal::Press next = hal::Press::none;
  hal::Press take() noexcept override { return std::exchange(next, hal::Press::none); }
};

class WholeRobotTest : public ::testing::Test {
 protected:
  template <class Done>
  bool run(double seconds, Done done) {
    for (const std::uint32_t end = now_ms + static_cast<std::uint32_t>(seconds * 1000); now_ms < end;) {
      ++now_ms;
      if (robot.poll(now_ms)) ++adoptions;
      outside.poll(now_ms);
      for (hal::CanFrame frame{}; outside.receive(frame);) ++frames;
      if (now_ms % 10 != 0) continue;
      robot.tick(now_ms);
      plant.advance();
      if (done()) return true;
    }
    return false;
  }
  void wait(double seconds) {
    run(seconds, [] { return false; });
  }
  bool stands() const { return std::fabs(plant.v_left()) < 1e-3 && std::fabs(plant.v_right()) < 1e-3; }
  planning::Outcome outcome() const { return robot.status().decision.outcome; }

  Params params;
  sim::WorldView world{};
  sim::Plant plant{world, sim::robot_spec(params), {}, 1, {}};
  hal::SimBoard board{plant};
  Hand hand;
  test::MemoryStorage tables{8192}, calibration{8192}, kept{8192};
  bus::MemoryBus cable;
  bus::MemoryPort& line = cable.attach();
  bus::MemoryPort& outside = cable.attach();
  WholeRobot robot{line, 7, params, {board, board, hand, nullptr, nullptr}, {tables, calibration, kept}};
  std::uint32_t now_ms = 0;
  int adoptions = 0;
  int frames = 0;
};

TEST_F(WholeRobotTest, RestsUntilItsButtonIsPressedThenDrivesAhead) {
  wait(3);
  EXPECT_EQ(robot.sign(), Sign::rests);
  EXPECT_NEAR(plant.pose().at.x, 0, 1e-6);
  EXPECT_GT(frames, 1000) << "the cable hears it";
  hand.next = hal::Press::brief;
  EXPECT_TRUE(run(30, [this] { return outcome() == planning::Outcome::reached && plant.pose().at.x > 1.8; }));
  EXPECT_NEAR(plant.pose().at.x, 2, 0.12);
  EXPECT_EQ(robot.status().health.fault, Fault::none);
  EXPECT_EQ(robot.status().health.late_ticks, 0U);
}

TEST_F(WholeRobotTest, APressWhileItDrivesStopsIt) {
  wait(2);
  hand.next = hal::Press::brief;
  ASSERT_TRUE(run(20, [this] { return plant.v_left() > 0.1 && plant.v_right() > 0.1; }));
  EXPECT_EQ(robot.sign(), Sign::drives);
  hand.next = hal::Press::brief;
  EXPECT_TRUE(run(1, [this] { return stands(); }));
  wait(3);
  EXPECT_TRUE(stands());
  EXPECT_EQ(robot.sign(), Sign::rests);
}

TEST_F(WholeRobotTest, AHeldButtonMeasuresTheTrackAndKeepsIt) {
  wait(2);
  hand.next = hal::Press::held;
  ASSERT_TRUE(run(10, [this] { return robot.sign() == Sign::calibrates; }));
  ASSERT_TRUE(run(90, [this] { return robot.sign() == Sign::rests; }));
  EXPECT_EQ(robot.status().health.fault, Fault::none);
  planning::Calibrator next(calibration);
  EXPECT_EQ(next.stored(), storage::Stored::nothing) << "an empty world shows no walls to measure by";
}

TEST_F(WholeRobotTest, ASensorThatIsNotThereIsAFaultAndNoMotion) {
  struct Blind final : hal::Rangefinders {
    bool read(hal::RangeReadings&) noexcept override { return false; }
  } blind;
  test::MemoryStorage own[3] = {test::MemoryStorage{8192}, test::MemoryStorage{8192},
                                test::MemoryStorage{8192}};
  WholeRobot other{line, 8, params, {blind, board, hand, nullptr, nullptr}, {own[0], own[1], own[2]}};
  for (std::uint32_t ms = 1; ms < 6000; ++ms) {
    other.poll(ms);
    if (ms == 3000) hand.next = hal::Press::brief;
    if (ms % 10 == 0) {
      other.tick(ms);
      plant.advance();
    }
  }
  EXPECT_EQ(other.status().health.fault, Fault::range_lost);
  EXPECT_EQ(other.sign(), Sign::failed);
  EXPECT_NEAR(plant.path_length(), 0, 1e-6);
}

TEST_F(WholeRobotTest, WhatAnOperatorCommitsIsKeptAndHoldsAtOnce) {
  wait(2);
  can::AliveSender alive;
  const auto say = [&](const can::ParamRequest& request) {
    outside.send(can::encode(request, 1, alive.next()), 100);
    wait(0.05);
  };
  std::uint8_t index = 0;
  Params wanted = params;
  wanted.wheels.max_speed = 200_mm_per_s;
  for (std::uint32_t before = 0, after = 0; can::read_param(params, index, before); ++index) {
    can::read_param(wanted, index, after);
    if (before != after) say({can::ParamAction::write, index, after});
  }
  say({can::ParamAction::commit, can::kCommitIndex, 0});
  wait(1);
  EXPECT_EQ(adoptions, 1);
  EXPECT_EQ(robot.params().wheels.max_speed, 200_mm_per_s);
  EXPECT_EQ(robot.sign(), Sign::rests);
  Params stored;
  EXPECT_EQ(can::ParamStore(kept, kVersionNumber).load(stored), storage::Stored::ok);
  EXPECT_EQ(stored.wheels.max_speed, 200_mm_per_s);
}

TEST(PicoParamsTest, AreThoseOfItsRobotFile) {
  Params file;
  apply_robot_file(file, WHISKER_SOURCE_DIR "/host/robots/pico.toml");
  for (int i = 0; i < kParams; ++i) EXPECT_EQ(raw_param(hal::pico::kRobotParams, i), raw_param(file, i)) << i;
}

}  // namespace
}  // namespace whisker::can_app

/// The whole image except its start-up: core and drivers run on models of the chip, whose pins move a
/// simulated robot.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "hal/boards/common/counts.hpp"
#include "hal/boards/stm32f405/pins.hpp"
#include "hal/boards/stm32f405/robot_board.hpp"
#include "hal/boards/stm32f405/robot_params.hpp"
#include "hal/boards/stm32f405/vl53l0x.hpp"
#include "host/harness/sim/elementary.hpp"
#include "host/harness/sim/plant.hpp"
#include "tests/boards/chip_fixture.hpp"
#include "tests/boards/models/mpu6050_model.hpp"
#include "tests/boards/models/vl53l0x_model.hpp"

namespace whisker::hal::stm32f405 {

class RobotBoardTest : public ::testing::Test, public ModelChip {
 protected:
  /// track: the true one / that of the parameters.
  explicit RobotBoardTest(const Params& with = kRobotParams, double track = 1)
      : params(with), plant{world, spec(track), {}, 1, {}} {
    // Without crystal and PLL, so that the clock is the models' 16 MHz.
    rcc.dead_crystal = rcc.pll_without_lock = true;
    for (model::Vl53l0xModel& s : sensor) i2c.attach(s);
    i2c.attach(imu);
    adc.raw = [this](std::uint32_t channel) { return infrared(static_cast<int>(channel) - 10); };
    gpio_c.on_rise = [this](std::uint8_t pin) {
      for (int i = 0; i < kBeams; ++i) {
        if (wiring::kRangerAwake[i].number == pin) sensor[i].reset_line(true);
      }
    };
    board.start();
    robot.place({});
  }

  void go(Length x) { robot.set_goal({{x, 0_mm}, 50_mm}); }
  /// Runs the loop for this time; returns true as soon as `done`.
  template <class Done>
  bool run(double seconds, Done done) {
    return run(
        seconds, done, [this] { board.poll(robot.status()); }, [this] { robot.tick(board.now()); });
  }
  template <class Done, class Poll, class Tick>
  bool run(double seconds, Done done, Poll poll, Tick tick) {
    const double end = chip.now_us() + seconds * 1e6;
    while (chip.now_us() < end) {
      poll();
      if (board.due(10)) {
        tick();
        if (done()) return true;
      }
      while (plant.time() * 1e6 < chip.now_us()) move_on();
    }
    return false;
  }
  static bool never() { return false; }

  const Params params;
  model::Vl53l0xModel sensor[kBeams];
  model::Mpu6050Model imu;
  RobotBoard board{kVl53l0x, kMotorParams, kMotorParams, params.gyro};
  planning::TableBoundaryPlanner planner{params, fuzzy::kDefaultTable};
  Robot robot{board.rangefinders(), board.drive(), planner.planner, params, nullptr, &board.gyro()};

  std::uint8_t sensed_as[kBeams] = {vl53l0x::kValid, vl53l0x::kValid, vl53l0x::kValid};
  sim::Segment wall{{0.8, -3.0}, {0.8, 3.0}};
  sim::WorldView world{nullptr, 0, &wall, 1};
  sim::Plant plant;

 private:
  static sim::RobotSpec spec(double track) {
    sim::RobotSpec s = sim::robot_spec(kRobotParams);
    s.latency_s = 0.0;
    s.max_speed = 0.4;
    // A light wall is seen farther than the parameters promise for all targets.
    for (sim::BeamSpec& beam : s.beams) beam.max_range = 2.0;
    s.track *= track;
    return s;
  }
  std::int16_t commanded(int wheel) {
    const bool forward = gpio_b.output(wiring::kDirections[2 * wheel].number);
    const bool backward = gpio_b.output(wiring::kDirections[2 * wheel + 1].number);
    const double speed = tim1.duty(wheel + 1) * kMotorParams.full_speed;
    return static_cast<std::int16_t>(forward == backward ? 0 : forward ? speed : -speed);
  }
  void move_on() {
    plant.command({commanded(0), commanded(1)});
    const double heading = plant.pose().heading;
    plant.advance();
    turn_imu((plant.pose().heading - heading) / 0.01);
    const EncoderCounts now = plant.encoders();
    tim3.turn(mcu::counts_between(seen_.left, now.left));
    tim4.turn(mcu::counts_between(seen_.right, now.right));
    seen_ = now;
    const RangeReadings ranges = plant.ranges();
    for (int i = 0; i < kBeams; ++i) {
      if (!gpio_c.output(wiring::kRangerAwake[i].number)) sensor[i].reset_line(false);
      const RangeReading& r = ranges.beam[i];
      if (r.sequence == measured_) continue;
      sensor[i].measure(r.status == RangeStatus::ok ? r.mm : vl53l0x::kOutOfReachMm, sensed_as[i]);
    }
    measured_ = ranges.beam[0].sequence;
  }
  /// A period at this rate, rad/s, which the chip shows with its bias.
  void turn_imu(double rate) {
    constexpr double kBias = 0.035;
    const double unit = params.gyro.range.raw() * 1e-6 / 32768;
    for (int ms = 0; ms < 10; ++ms) imu.pass(static_cast<int>(std::lround((rate + kBias) / unit)));
  }
  int infrared(int beam) {
    const RangeReading r = plant.ranges().beam[beam];
    const bool seen = r.status == RangeStatus::ok && r.mm >= 60 && r.mm < 1500;
    return (seen ? mcu::voltage_at(mcu::kGp2y0a21, static_cast<std::int16_t>(r.mm)) : 200) * 4095 / 3300;
  }
  EncoderCounts seen_{};
  std::uint8_t measured_ = 15;
};

}  // namespace whisker::hal::stm32f405

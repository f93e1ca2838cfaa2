#include "hal/boards/stm32f405/robot_board.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "hal/boards/common/counts.hpp"
#include "hal/boards/stm32f405/pins.hpp"
#include "hal/boards/stm32f405/robot_params.hpp"
#include "hal/boards/stm32f405/vl53l0x.hpp"
#include "host/sim/elementary.hpp"
#include "host/sim/plant.hpp"
#include "tests/boards/chip_fixture.hpp"
#include "tests/boards/models/mpu6050_model.hpp"
#include "tests/boards/models/vl53l0x_model.hpp"

namespace whisker::hal::stm32f405 {
namespace {

/// The whole image except its start-up: core and drivers run on models of the chip, whose pins move a
/// simulated robot.
class RobotBoardTest : public ::testing::Test, public ModelChip {
 protected:
  explicit RobotBoardTest(const Params& with = kRobotParams) : params(with) {
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
    const double end = chip.now_us() + seconds * 1e6;
    while (chip.now_us() < end) {
      board.poll(robot.status());
      if (board.due(10)) {
        robot.tick(board.now());
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

  sim::Segment wall{{0.8, -3.0}, {0.8, 3.0}};
  sim::WorldView world{nullptr, 0, &wall, 1};
  sim::Plant plant{world, spec(), {}, 1, {}};

 private:
  static sim::RobotSpec spec() {
    sim::RobotSpec s = sim::robot_spec(kRobotParams);
    s.latency_s = 0.0;
    s.max_speed = 0.4;
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
      sensor[i].measure(r.status == RangeStatus::ok ? r.mm : vl53l0x::kOutOfReachMm);
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

TEST_F(RobotBoardTest, DrivesToItsGoalThroughTheChipsRegisters) {
  go(500_mm);
  EXPECT_TRUE(run(30, [this] { return robot.status().decision.outcome == planning::Outcome::reached; }));
  EXPECT_FALSE(plant.in_contact());
  EXPECT_NEAR(plant.pose().at.x, 0.5, 0.06);
  EXPECT_NEAR(plant.pose().at.y, 0, 0.03);
  EXPECT_EQ(robot.status().health.fault, Fault::none);
  EXPECT_EQ(robot.status().health.late_ticks, 0U);
  EXPECT_EQ(board.troubles().total(), 2U) << usart.sent;  // crystal and PLL
}

TEST_F(RobotBoardTest, AGoalBehindAWallEndsWithoutAContact) {
  go(790_mm);
  run(10,
      [this] { return robot.status().decision.outcome != planning::Outcome::running && plant.time() > 1; });
  EXPECT_FALSE(plant.in_contact());
  EXPECT_GT(plant.pose().at.x, 0.3);
}

TEST_F(RobotBoardTest, ASensorThatDiesStopsTheRobotWithItsName) {
  wall = {{9, -3}, {9, 3}};
  go(5_m);
  ASSERT_TRUE(run(10, [this] { return plant.v_left() > 0.1 && plant.v_right() > 0.1; }));
  sensor[1].dead = true;
  run(3, never);
  EXPECT_EQ(robot.status().health.fault, Fault::range_lost);
  EXPECT_GE(board.troubles().of(Trouble::ranger_silent), 1U);
  EXPECT_FALSE(plant.in_contact());
  EXPECT_EQ(tim1.duty(1), 0);
  EXPECT_EQ(tim1.duty(2), 0);
  EXPECT_NE(usart.sent.find("fault range_lost"), std::string::npos);
  EXPECT_NE(usart.sent.find("ranger_silent"), std::string::npos);
}

TEST_F(RobotBoardTest, TheWatchdogIsFedWithEachTickOnly) {
  run(1, never);
  const int feedings = iwdg.feedings;
  run(1, never);
  EXPECT_NEAR(iwdg.feedings - feedings, 100, 1);
  for (int i = 0; i < 1000; ++i) board.poll(robot.status());
  EXPECT_NEAR(iwdg.feedings - feedings, 100, 1);
}

TEST_F(RobotBoardTest, EverythingDeadAtTheStartEndsInNamesInBoundedTime) {
  model::Chip another;
  model::Peripheral nothing[16];
  const Address bases[] = {base::kRcc,  base::kFlash, base::kGpioA, base::kGpioB, base::kGpioC,
                           base::kTim1, base::kTim2,  base::kTim3,  base::kTim4,  base::kI2c1,
                           base::kAdc1, base::kCan1,  base::kIwdg,  base::kNvic,  base::kUsart2};
  int i = 0;
  for (const Address b : bases) another.attach(b, nothing[i++]);
  RobotBoard dead(kVl53l0x, kMotorParams, kMotorParams);
  dead.start();
  EXPECT_LT(another.now_us(), 100000);
  EXPECT_EQ(dead.can().state(), CanState::off);
  EXPECT_EQ(dead.troubles().of(Trouble::crystal_not_ready), 1U);
  EXPECT_EQ(dead.troubles().of(Trouble::pll_not_locked), 1U);
}

TEST(RobotParamsTest, AreOnesThatTheCoreAccepts) { EXPECT_EQ(check(kRobotParams), ParamFault::none); }

TEST_F(RobotBoardTest, ReadsTheBumpSwitchesWithoutTheirBouncing) {
  std::uint32_t closed = 0;  // by pin
  gpio_c.held_low = [&](std::uint8_t pin) { return (closed >> pin & 1U) != 0; };
  for (const Pin pin : wiring::kBumpers) {
    EXPECT_EQ(gpio_c.mode(pin.number), model::GpioModel::kInput);
    EXPECT_TRUE(gpio_c.pulled_up(pin.number));
  }
  BumpSwitches switches;
  const auto at = [&](std::uint32_t ms, std::uint32_t pins) {
    closed = pins;
    switches.poll(ms);
    BumperReading reading{255};
    EXPECT_TRUE(switches.read(reading));
    return reading.pressed;
  };
  const std::uint32_t left = 1U << wiring::kBumpers[0].number, right = 1U << wiring::kBumpers[1].number;
  EXPECT_EQ(at(100, 0), 0);
  EXPECT_EQ(at(101, left), 1U << kLeft) << "at once";
  EXPECT_EQ(at(103, 0), 1U << kLeft) << "it bounces";
  EXPECT_EQ(at(105, left | right), 1U << kLeft | 1U << kRight);
  EXPECT_EQ(at(115, left), 1U << kLeft | 1U << kRight);
  EXPECT_EQ(at(125, left), 1U << kLeft) << "open for 20 ms";
  EXPECT_EQ(at(144, 0), 1U << kLeft);
  EXPECT_EQ(at(145, 0), 0);

  closed = right;
  switches.poll(200);
  closed = 0;
  switches.poll(300);
  EXPECT_EQ(at(301, 0), 1U << kRight) << "a press between two reads is not missed";
  EXPECT_EQ(at(302, 0), 0);
}

TEST_F(RobotBoardTest, ABumpStopsTheMotors) {
  Params own_params = kRobotParams;
  own_params.bumper.fitted = Fitted::yes;
  planning::TableBoundaryPlanner own{own_params, fuzzy::kDefaultTable};
  Robot bumped{board.rangefinders(), board.drive(), own.planner, own_params, &board.bumper()};
  bool closed = false;
  gpio_c.held_low = [&](std::uint8_t pin) { return closed && pin == wiring::kBumpers[0].number; };
  const auto pass = [&](int ticks) {
    for (int i = 0; i < ticks;) {
      board.poll(bumped.status());
      if (!board.due(10)) continue;
      bumped.tick(board.now());
      ++i;
    }
  };
  bumped.place({});
  pass(50);
  bumped.set_goal({{500_mm, 0_mm}, 50_mm});
  pass(5);
  closed = true;
  pass(1);
  EXPECT_EQ(bumped.status().pressed, 1U << kLeft);
  EXPECT_EQ(bumped.status().command.left, 0);
  EXPECT_EQ(bumped.status().decision.why, planning::Why::bumped);
  EXPECT_EQ(bumped.status().health.bumps, 1U);
}

TEST_F(RobotBoardTest, WithoutAGyroNothingAsksForIt) {
  go(200_mm);
  run(2, never);
  EXPECT_EQ(imu.resets, 0);
  EXPECT_EQ(robot.status().heading_source, localization::HeadingSource::wheels);
}

constexpr Params with_gyro() {
  Params p = kRobotParams;
  p.gyro.fitted = Fitted::yes;
  return p;
}

class GyroBoardTest : public RobotBoardTest {
 protected:
  GyroBoardTest() : RobotBoardTest(with_gyro()) {}
  bool reached() const { return robot.status().decision.outcome == planning::Outcome::reached; }
};

TEST_F(GyroBoardTest, DrivesByTheGyroThroughTheChipsRegisters) {
  robot.set_goal({{400_mm, 300_mm}, 50_mm});
  EXPECT_TRUE(run(30, [this] { return reached(); }));
  EXPECT_EQ(robot.status().heading_source, localization::HeadingSource::gyro);
  EXPECT_EQ(robot.status().health.gyro_lost, 1U) << "the chip starts for a quarter of a second";
  EXPECT_EQ(robot.status().health.late_ticks, 0U);
  EXPECT_EQ(robot.status().health.wheel_slips, 0U);
  EXPECT_NEAR(robot.status().pose.heading.wrapped() * (sim::kPi / 2147483648.0), plant.pose().heading, 0.02);
  EXPECT_NEAR(plant.pose().at.x, 0.4, 0.07);
  EXPECT_NEAR(plant.pose().at.y, 0.3, 0.07);
  EXPECT_FALSE(plant.in_contact());
  EXPECT_EQ(board.troubles().total(), 2U) << usart.sent;  // crystal and PLL
}

TEST_F(GyroBoardTest, AGyroThatDiesHasANameAndTheWheelsGoOn) {
  go(600_mm);
  ASSERT_TRUE(run(20, [this] { return plant.v_left() > 0.1 && plant.v_right() > 0.1; }));
  imu.dead = true;
  EXPECT_TRUE(run(30, [this] { return reached(); }));
  EXPECT_EQ(robot.status().heading_source, localization::HeadingSource::gyro_lost);
  EXPECT_EQ(robot.status().health.gyro_lost, 2U) << "at the start, and now";
  EXPECT_EQ(robot.status().health.fault, Fault::none);
  EXPECT_EQ(board.troubles().of(Trouble::gyro_silent), 1U);
  EXPECT_NE(usart.sent.find("gyro_silent 1"), std::string::npos);
}

}  // namespace
}  // namespace whisker::hal::stm32f405

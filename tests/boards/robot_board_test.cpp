#include <gtest/gtest.h>

#include <string>

#include "firmware/apps/calibration/self_calibration.hpp"
#include "tests/boards/models/flash_model.hpp"
#include "tests/boards/robot_fixture.hpp"

namespace whisker::hal::stm32f405 {
namespace {

using calibration::Quantity;
using calibration::Stored;

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

TEST_F(RobotBoardTest, AWallBeyondTheMaximumRangeIsNoLostReading) {
  for (const double x : {1.5, 1.9}) {
    wall = {{x, -3.0}, {x, 3.0}};
    robot.reset();
    go(robot.status().pose.at.x + 250_mm);
    EXPECT_TRUE(run(20, [this] { return robot.status().decision.outcome == planning::Outcome::reached; }))
        << name(robot.status().health.fault);
    EXPECT_GT(robot.status().health.range_out_of_range, 0U) << x;
  }
}

TEST_F(RobotBoardTest, LasersThatFailAreLostAndNotClear) {
  for (std::uint8_t& status : sensed_as) status = 1;
  wall = {{9, -3}, {9, 3}};
  go(1500_mm);
  EXPECT_TRUE(run(2, [this] { return robot.status().health.fault == Fault::range_lost; }));
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

// The button, the core's drive and the flash of the whole board, on models of the chip.

constexpr double kTrack = 1.02;

class SelfCalibrationBoardTest : public RobotBoardTest {
 protected:
  SelfCalibrationBoardTest() : RobotBoardTest(kRobotParams, kTrack) {
    flash.on_erase = [this] { timeout_ms_at_erasure = iwdg.timeout_ms(); };
    gpio_c.held_low = [this](std::uint8_t pin) { return pressed && pin == wiring::kButton.number; };
  }
  template <class Done>
  bool go(double seconds, Done done) {
    return run(
        seconds, done, [this] { board.poll(self.status(), self.word()); },
        [this] { self.tick(board.now()); });
  }
  bool ended() const { return self.phase() == SelfCalibration::Phase::ended; }

  model::FlashMemory memory{chip, Storage::kSlotBytes};
  model::FlashModel& flash = memory.model;
  bool pressed = false;
  double timeout_ms_at_erasure = 0;
  planning::Calibrator calibrator{board.storage()};
  SelfCalibration self{robot,
                       calibrator,
                       kRobotParams,
                       board.button(),
                       {board.rangefinders(), board.drive(), nullptr, &board.gyro()}};
};

TEST_F(SelfCalibrationBoardTest, AHeldButtonMeasuresTheTrackAndTheFlashKeepsIt) {
  EXPECT_EQ(calibrator.stored(), Stored::nothing);
  go(1, never);
  pressed = true;
  go(1.2, never);
  pressed = false;
  EXPECT_EQ(self.phase(), SelfCalibration::Phase::starts);
  ASSERT_TRUE(go(60, [this] { return ended(); })) << usart.sent;
  EXPECT_STREQ(self.word(), "ok");
  EXPECT_FALSE(plant.in_contact());
  EXPECT_EQ(flash.erasures[10] + flash.erasures[11], 1);
  // The oscillator of the watchdog may be 47 kHz instead of 32, and an erasure take 2 s.
  EXPECT_GT(timeout_ms_at_erasure * 32 / 47, 2000);
  EXPECT_NEAR(iwdg.timeout_ms(), RobotBoard::kWatchdogMs, 1);

  go(3, never);
  EXPECT_TRUE(ended());
  EXPECT_EQ(self.status().health.fault, Fault::none);
  EXPECT_EQ(tim1.duty(1), 0);
  EXPECT_EQ(tim1.duty(2), 0);
  EXPECT_NE(usart.sent.find("calibration starts\r\n"), std::string::npos);
  EXPECT_NE(usart.sent.find("calibration measures\r\n"), std::string::npos);
  EXPECT_NE(usart.sent.find("calibration ok\r\n"), std::string::npos);
  EXPECT_EQ(board.troubles().total(), 2U) << usart.sent;  // crystal and PLL

  // The next start.
  const planning::Calibrator next(board.storage());
  Params own = kRobotParams;
  next.apply(own);
  EXPECT_NEAR(own.body.track.raw(), kTrack * kRobotParams.body.track.raw(), 1e-3 * own.body.track.raw());
  EXPECT_EQ(check(own), ParamFault::none);
}

TEST_F(SelfCalibrationBoardTest, AWatchdogThatTakesNoLongerTimeoutCostsTheSaveAndNothingElse) {
  iwdg.never_ready = true;
  EXPECT_FALSE(board.storage().erase(0));
  EXPECT_EQ(flash.erasures[10], 0);
  EXPECT_GE(board.troubles().of(Trouble::watchdog_not_ready), 1U);
}

TEST_F(SelfCalibrationBoardTest, BeforeTheWatchdogRunsAnErasureDoesNotStartIt) {
  model::IwdgModel idle;
  chip.attach(base::kIwdg, idle);
  Watchdog watchdog;
  WatchedStorage storage(FlashUse::calibration, watchdog, troubles);
  EXPECT_TRUE(storage.erase(1));
  EXPECT_EQ(flash.erasures[11], 1);
  EXPECT_FALSE(idle.running);
}

}  // namespace
}  // namespace whisker::hal::stm32f405

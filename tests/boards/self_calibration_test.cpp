// The button, the core's drive and the flash of the whole board, on models of the chip.
#include <gtest/gtest.h>

#include <string>

#include "firmware/apps/calibration/self_calibration.hpp"
#include "tests/boards/models/flash_model.hpp"
#include "tests/boards/robot_fixture.hpp"

namespace whisker::hal::stm32f405 {
namespace {

using calibration::Quantity;
using calibration::Stored;

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

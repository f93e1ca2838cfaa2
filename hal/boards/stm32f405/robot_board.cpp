#include "hal/boards/stm32f405/robot_board.hpp"

#include "hal/board.hpp"
#include "hal/boards/stm32f405/interrupts.hpp"
#include "hal/boards/stm32f405/pins.hpp"

namespace whisker::hal::stm32f405 {
namespace {

RobotBoard* interrupted = nullptr;

}  // namespace

RobotBoard::RobotBoard(const RangerKind& kind, const mcu::MotorParams& left, const mcu::MotorParams& right,
                       const GyroParams& gyro, Facing facing) noexcept
    : tof_(kind, bus_, troubles_),
      gyro_(gyro, facing, bus_, troubles_),
      has_gyro_(gyro.fitted == Fitted::yes),
      infrared_(mcu::kGp2y0a21, mcu::kGp2y0a21PeriodMs, wiring::kInfraredChannel, adc_),
      beams_(tof_, infrared_),
      wheels_(left, right, motors_, encoders_, ticker_),
      storage_(watchdog_, troubles_),
      reporter_(console_, troubles_, can_) {}

void RobotBoard::start() noexcept {
  power_peripherals();
  set_up_pins();
  const Clocks clocks = start_clocks(troubles_);
  ticker_.start(clocks);
  motors_.start(clocks);
  encoders_.start();
  console_.start(kConsoleBaud, clocks);
  bus_.start(clocks, troubles_);
  adc_.start(clocks, troubles_);
  can_.start(kCanBitrate, clocks);
  interrupted = this;
  enable(Interrupt::usart2);
  enable(Interrupt::can1_receive0);
  watchdog_.start(kWatchdogMs, clocks, troubles_);
  storage_.start(clocks, kWatchdogMs);
  const uint32_t now = ticker_.now_ms();
  tof_.start(now);
  gyro_.start(now);
  infrared_.start(now);
  schedule_.begin(now);
}

void RobotBoard::poll(const Status& status, const char* calibration) noexcept {
  const uint32_t now = ticker_.now_ms();
  can_.poll(now);
  tof_.poll(now);
  if (has_gyro_) gyro_.poll(now);
  infrared_.poll(now);
  switches_.poll(now);
  button_.poll(now);
  reporter_.poll(now, status, calibration);
}

bool RobotBoard::due(uint32_t period_ms) noexcept {
  if (!schedule_.due(ticker_.now_ms(), period_ms)) return false;
  watchdog_.feed();
  return true;
}

}  // namespace whisker::hal::stm32f405

/// Until the watchdog resets the chip.
void whisker::hal::leave(int) noexcept {
  for (;;) {
  }
}

extern "C" {

void usart2_interrupt() noexcept;
void can1_receive_interrupt() noexcept;

void usart2_interrupt() noexcept { whisker::hal::stm32f405::interrupted->on_console_interrupt(); }
void can1_receive_interrupt() noexcept { whisker::hal::stm32f405::interrupted->on_can_interrupt(); }
}

#include "hal/boards/stm32f405/node_board.hpp"

#include "hal/board.hpp"
#include "hal/boards/stm32f405/interrupts.hpp"
#include "hal/boards/stm32f405/motors.hpp"
#include "hal/boards/stm32f405/pins.hpp"
#include "hal/boards/stm32f405/random.hpp"

namespace whisker::hal::stm32f405 {
namespace {

NodeBoard* interrupted = nullptr;

}  // namespace

void NodeBoard::start() noexcept {
  power_peripherals();
  set_up_pins();
  clocks_ = start_clocks(troubles_);
  ticker_.start(clocks_);
  console_.start(kConsoleBaud, clocks_);
  can_.start(kCanBitrate, clocks_);
  interrupted = this;
  enable(Interrupt::usart2);
  enable(Interrupt::can1_receive0);
}

void NodeBoard::watch() noexcept {
  watchdog_.start(kWatchdogMs, clocks_, troubles_);
  tables_.start(clocks_, kWatchdogMs);
  calibration_.start(clocks_, kWatchdogMs);
  schedule_.begin(now_ms());
}

void NodeBoard::report(const Status& status, const char* calibration) noexcept {
  reporter_.poll(now_ms(), status, calibration);
}

bool NodeBoard::due(uint32_t period_ms) noexcept {
  if (!schedule_.due(now_ms(), period_ms)) return false;
  watchdog_.feed();
  return true;
}

uint16_t NodeBoard::boot_number() noexcept {
  uint32_t number = ticker_.now_us();
  draw_random(clocks_, troubles_, number);
  return static_cast<uint16_t>(number ^ number >> 16);
}

}  // namespace whisker::hal::stm32f405

/// Until the watchdog resets the chip.
void whisker::hal::leave(int) noexcept {
  whisker::hal::stm32f405::Motors::cut_off();
  for (;;) {
  }
}

extern "C" {

void usart2_interrupt() noexcept;
void can1_receive_interrupt() noexcept;

void usart2_interrupt() noexcept { whisker::hal::stm32f405::interrupted->on_console_interrupt(); }
void can1_receive_interrupt() noexcept { whisker::hal::stm32f405::interrupted->on_can_interrupt(); }
}

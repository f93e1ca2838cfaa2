#include "hal/boards/atmega1284p/robot_board.hpp"

#include "hal/board.hpp"
#include "hal/boards/atmega1284p/pins.hpp"

namespace whisker::hal::atmega1284p {
namespace {

RobotBoard* interrupted = nullptr;

}  // namespace

RobotBoard::RobotBoard(const mcu::MotorParams& left, const mcu::MotorParams& right) noexcept
    : sonar_(troubles_),
      adc_(troubles_),
      infrared_(mcu::kGp2y0a21, mcu::kGp2y0a21PeriodMs, wiring::kInfraredChannel, adc_),
      beams_(sonar_, infrared_),
      encoders_(troubles_),
      wheels_(left, right, motors_, encoders_, clock_) {}

void RobotBoard::start() noexcept {
  interrupted = this;
  watchdog_.start();
  motors_.start();
  encoders_.start();
  adc_.start();
  clock_.start();
  sonar_.start(0);
  infrared_.start(0);
  store(reg::kSMCR, bits::kSE);  // idle: the timers run on
  asm volatile("sei" ::: "memory");
}

void RobotBoard::poll() noexcept {
  const uint32_t now = clock_.now_ms();
  sonar_.poll(now);
  infrared_.poll(now);
  asm volatile("sleep" ::: "memory");
}

bool RobotBoard::due(uint8_t period_ms) noexcept {
  const uint32_t now = clock_.now_ms();
  if (now - tick_ms_ < period_ms) return false;
  tick_ms_ += period_ms;
  while (now - tick_ms_ >= period_ms) {
    troubles_.count(Trouble::missed_ticks);
    tick_ms_ += period_ms;
  }
  watchdog_.feed();
  store(reg::kGPIOR0, 1);
  return true;
}

void RobotBoard::show(const Status& status) noexcept {
  store(reg::kGPIOR0, 0);
  store(reg::kGPIOR1, static_cast<uint8_t>(static_cast<uint8_t>(status.health.fault) +
                                           16 * static_cast<uint8_t>(status.decision.outcome)));
  const uint32_t troubles = troubles_.total();
  store(reg::kGPIOR2, static_cast<uint8_t>(troubles > UINT8_MAX ? UINT8_MAX : troubles));
}

}  // namespace whisker::hal::atmega1284p

/// Until the watchdog resets the chip.
void whisker::hal::leave(int) noexcept {
  for (;;) {
  }
}

extern "C" {

// The numbers are those of the chip's vector table.
[[gnu::signal, gnu::used]] void __vector_5() noexcept;   // PCINT2
[[gnu::signal, gnu::used]] void __vector_7() noexcept;   // TIMER2_COMPA
[[gnu::signal, gnu::used]] void __vector_10() noexcept;  // TIMER1_CAPT

void __vector_5() noexcept { whisker::hal::atmega1284p::interrupted->encoders().on_interrupt(); }
void __vector_7() noexcept { whisker::hal::atmega1284p::interrupted->ticker().on_interrupt(); }
void __vector_10() noexcept { whisker::hal::atmega1284p::interrupted->sonar().on_interrupt(); }
}

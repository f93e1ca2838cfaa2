#include "hal/boards/pico/echo_lines.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/pico/clock.hpp"
#include "hal/boards/pico/interrupts.hpp"
#include "hal/boards/pico/pins.hpp"
#include "hal/boards/pico/reg/io_bank0.hpp"
#include "hal/boards/pico/ticker.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kPulseUs = 10;
constexpr uint32_t kPinsOfRegister = 8;

constexpr Register of_pin(Register first, Gpio pin) noexcept {
  return {static_cast<uint16_t>(first.offset + pin / kPinsOfRegister * sizeof(uint32_t))};
}
constexpr uint32_t edges(Gpio pin) noexcept {
  return (mask(io_bank0::kGpio0EdgeLow) | mask(io_bank0::kGpio0EdgeHigh)) << pin % kPinsOfRegister * 4;
}

}  // namespace

void EchoLines::adopt(bool fitted) noexcept {
  fitted_ = fitted;
  for (const Gpio pin : wiring::kEchoes) {
    const Register enabled = of_pin(io_bank0::kProc0Inte0, pin);
    if (fitted) {
      set_bits(base::kIoBank0, enabled, edges(pin));
    } else {
      clear_bits(base::kIoBank0, enabled, edges(pin));
    }
  }
  enable(Interrupt::io_bank0);
}

void EchoLines::poll() noexcept {
  if (!fitted_) return;
  const int beam = sonars_.take_turn(Ticker::now_us());
  if (beam == mcu::Sonars::kNone) return;
  write(wiring::kTriggers[beam], true);
  const uint32_t began_us = Ticker::now_us();
  for (Patience patience = Patience::for_us(2 * kPulseUs, kCoreHz); patience.spend();) {
    if (Ticker::now_us() - began_us > kPulseUs) break;
  }
  write(wiring::kTriggers[beam], false);
}

void EchoLines::on_interrupt() noexcept {
  const uint32_t now_us = Ticker::now_us();
  for (int i = 0; i < kBeams; ++i) {
    const Gpio pin = wiring::kEchoes[i];
    const uint32_t seen = load(base::kIoBank0, of_pin(io_bank0::kProc0Ints0, pin)) & edges(pin);
    if (seen == 0) continue;
    store(base::kIoBank0, of_pin(io_bank0::kIntr0, pin), seen);
    sonars_.on_edge(i, pico::read(pin), now_us);
  }
}

}  // namespace whisker::hal::pico

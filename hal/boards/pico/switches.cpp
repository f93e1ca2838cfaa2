#include "hal/boards/pico/switches.hpp"

#include "hal/boards/pico/pins.hpp"

namespace whisker::hal::pico {

void BumpSwitches::poll(uint32_t now_ms) noexcept {
  left_.sample(!pico::read(wiring::kLeftBumper), now_ms);
  right_.sample(!pico::read(wiring::kRightBumper), now_ms);
}

bool BumpSwitches::read(BumperReading& out) noexcept {
  const bool left = left_.take(), right = right_.take();
  out.pressed = static_cast<uint8_t>((left ? 1U << kLeft : 0U) | (right ? 1U << kRight : 0U));
  return true;
}

void PushButton::poll(uint32_t now_ms) noexcept { presses_.sample(!pico::read(wiring::kButton), now_ms); }

}  // namespace whisker::hal::pico

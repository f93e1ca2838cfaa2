#include "hal/boards/stm32f405/bump_switches.hpp"

#include "hal/boards/stm32f405/pins.hpp"

namespace whisker::hal::stm32f405 {

void BumpSwitches::poll(uint32_t now_ms) noexcept {
  left_.sample(!stm32f405::read(wiring::kBumpers[0]), now_ms);
  right_.sample(!stm32f405::read(wiring::kBumpers[1]), now_ms);
}

bool BumpSwitches::read(BumperReading& out) noexcept {
  const uint32_t left = left_.take() ? 1U << kLeft : 0;
  const uint32_t right = right_.take() ? 1U << kRight : 0;
  out.pressed = static_cast<uint8_t>(left | right);
  return true;
}

}  // namespace whisker::hal::stm32f405

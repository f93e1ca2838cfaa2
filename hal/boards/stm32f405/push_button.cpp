#include "hal/boards/stm32f405/push_button.hpp"

#include "hal/boards/stm32f405/pins.hpp"

namespace whisker::hal::stm32f405 {

void PushButton::poll(uint32_t now_ms) noexcept {
  presses_.sample(!stm32f405::read(wiring::kButton), now_ms);
}

}  // namespace whisker::hal::stm32f405

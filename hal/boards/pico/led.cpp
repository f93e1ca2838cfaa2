#include "hal/boards/pico/led.hpp"

#include "hal/boards/pico/pins.hpp"

namespace whisker::hal::pico {

void Led::show(uint16_t pattern, uint32_t now_ms) noexcept {
  write(wiring::kLed, (pattern >> now_ms / kSixteenthMs % 16 & 1U) != 0);
}

}  // namespace whisker::hal::pico

#include "hal/boards/stm32f405/interrupts.hpp"

#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/nvic.hpp"

namespace whisker::hal::stm32f405 {

void enable(Interrupt interrupt) noexcept {
  const auto position = static_cast<uint32_t>(interrupt);
  store(base::kNvic, nvic::kIser[position / 32], UINT32_C(1) << (position % 32));
}

}  // namespace whisker::hal::stm32f405

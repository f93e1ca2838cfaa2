#pragma once

#include <stdint.h>

namespace whisker::hal::stm32f405 {

/// Positions in the vector table that the board uses; see the vector table in the reference manual.
enum class Interrupt : uint8_t { can1_receive0 = 20, usart2 = 38 };
constexpr uint8_t kInterrupts = 82;

void enable(Interrupt interrupt) noexcept;

}  // namespace whisker::hal::stm32f405

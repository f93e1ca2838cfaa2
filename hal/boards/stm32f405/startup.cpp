// Vector table and reset. Sections and symbols are those of hal/runtime/cortex_m/sections.ld.
#include "hal/boards/stm32f405/interrupts.hpp"
#include "hal/boards/stm32f405/motors.hpp"
#include "hal/runtime/sections.hpp"

int main();

extern "C" {

extern uint32_t __stack_top[];

[[noreturn]] void reset() noexcept;
void usart2_interrupt() noexcept;
void can1_receive_interrupt() noexcept;
}

namespace {

using Handler = void (*)();
using whisker::hal::stm32f405::Interrupt;

/// No fault or other interrupt is expected. The pulses would go on without the processor, so the motors are
/// cut off first; then the watchdog, which is no longer fed, resets the chip.
[[noreturn]] void stand_still() noexcept {
  whisker::hal::stm32f405::Motors::cut_off();
  for (;;) {
  }
}

struct Vectors {
  uint32_t* stack;
  Handler exception[15];
  Handler interrupt[whisker::hal::stm32f405::kInterrupts];
};

constexpr Vectors vectors() noexcept {
  Vectors v{};
  v.stack = __stack_top;
  for (Handler& handler : v.exception) handler = stand_still;
  for (Handler& handler : v.interrupt) handler = stand_still;
  v.exception[0] = reset;
  v.interrupt[static_cast<int>(Interrupt::usart2)] = usart2_interrupt;
  v.interrupt[static_cast<int>(Interrupt::can1_receive0)] = can1_receive_interrupt;
  return v;
}

[[gnu::used, gnu::section(".vectors")]] constexpr Vectors kVectors = vectors();

}  // namespace

void reset() noexcept {
  whisker::hal::mcu::begin_memory();
  main();
  stand_still();
}

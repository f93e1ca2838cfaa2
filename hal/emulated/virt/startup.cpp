// From reset to main. Sections and symbols are those of hal/emulated/virt/virt.ld.
#include "hal/board.hpp"
#include "hal/emulated/common/semihosting.hpp"
#include "hal/runtime/stack.hpp"

int main();

extern "C" {

extern uint32_t __bss_start[];
extern uint32_t __bss_end[];

[[noreturn]] void reset() noexcept;
[[noreturn]] void begin() noexcept;
[[noreturn]] void unexpected() noexcept;

/// Handles every trap.
[[gnu::aligned(4)]] void unexpected() noexcept { whisker::hal::leave(99); }

void begin() noexcept {
  using namespace whisker::hal::mcu;
  asm volatile("csrw mtvec, %0" : : "r"(unexpected));
  for (volatile uint32_t* to = __bss_start; to < __bss_end; ++to) *to = 0;
  paint_stack(static_cast<uint32_t*>(__builtin_frame_address(0)) - 8);
  whisker::hal::leave(main());
}

/// Only hart 0 continues.
[[gnu::naked, gnu::section(".reset")]] void reset() noexcept {
  asm volatile(
      "la sp, __stack_top\n"
      "j begin\n");
}
}

namespace whisker::hal::mcu {

// The debugger recognises the instructions around ebreak; they must be uncompressed.
[[gnu::naked, gnu::noinline, gnu::aligned(16)]] uintptr_t semihost(uintptr_t, const void*) noexcept {
  asm volatile(
      ".option push\n"
      ".option norvc\n"
      "slli x0, x0, 0x1f\n"
      "ebreak\n"
      "srai x0, x0, 7\n"
      ".option pop\n"
      "ret\n");
}

}  // namespace whisker::hal::mcu

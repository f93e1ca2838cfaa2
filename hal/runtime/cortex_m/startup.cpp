// Vector table and reset. Sections and symbols are those of hal/runtime/cortex_m/sections.ld.
#include "hal/board.hpp"
#include "hal/runtime/stack.hpp"

int main();

extern "C" {

extern uint32_t __data_load[];
extern uint32_t __data_start[];
extern uint32_t __data_end[];
extern uint32_t __bss_start[];
extern uint32_t __bss_end[];

[[noreturn]] void reset() noexcept;
[[noreturn]] void unexpected() noexcept;

void reset() noexcept {
  using namespace whisker::hal::mcu;
  const uint32_t* from = __data_load;
  for (volatile uint32_t* to = __data_start; to < __data_end; ++to) *to = *from++;
  for (volatile uint32_t* to = __bss_start; to < __bss_end; ++to) *to = 0;
  paint_stack(static_cast<uint32_t*>(__builtin_frame_address(0)) - 8);
  whisker::hal::leave(main());
}

/// Handles every unexpected exception, including faults.
void unexpected() noexcept { whisker::hal::leave(99); }
}

namespace {

using Handler = void (*)();

/// The sixteen entries of every Cortex-M; no image here enables an interrupt.
struct Vectors {
  uint32_t* stack;
  Handler handler[15];
};

[[gnu::used, gnu::section(".vectors")]] const Vectors kVectors = {
    __stack_top,
    {reset, unexpected, unexpected, unexpected, unexpected, unexpected, nullptr, nullptr, nullptr, nullptr,
     unexpected, unexpected, nullptr, unexpected, unexpected}};

}  // namespace

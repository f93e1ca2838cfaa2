// Vector table and reset. Sections and symbols are those of hal/runtime/cortex_m/sections.ld.
#include "hal/board.hpp"
#include "hal/runtime/sections.hpp"
#include "hal/runtime/stack.hpp"

int main();

extern "C" {

[[noreturn]] void reset() noexcept;
[[noreturn]] void unexpected() noexcept;

void reset() noexcept {
  using namespace whisker::hal::mcu;
  begin_memory();
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

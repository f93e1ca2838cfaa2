/// Stack depth: the start-up code paints the stack, and overwritten paint was used.
#pragma once

#include <stdint.h>

/// Defined by the linker script.
extern "C" uint32_t __stack_bottom[];
extern "C" uint32_t __stack_top[];

namespace whisker::hal::mcu {

constexpr uint32_t kPaint = 0xC0DEC0DEU;

/// Call it from a function that starts with an empty stack.
inline void paint_stack(uint32_t* upto) noexcept {
  for (volatile uint32_t* p = __stack_bottom; p < upto; ++p) *p = kPaint;
}

inline uint32_t deepest_stack() noexcept {
  const uint32_t* p = __stack_bottom;
  while (p < __stack_top && *p == kPaint) ++p;
  return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(__stack_top) - reinterpret_cast<uintptr_t>(p));
}

}  // namespace whisker::hal::mcu

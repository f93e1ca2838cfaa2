/// Memory at the start of a program, as hal/runtime/cortex_m/sections.ld lays it out.
#pragma once

#include <stdint.h>

extern "C" {
extern uint32_t __data_load[];
extern uint32_t __data_start[];
extern uint32_t __data_end[];
extern uint32_t __bss_start[];
extern uint32_t __bss_end[];
}

namespace whisker::hal::mcu {

/// Gives variables their first values. Call it before anything reads one.
inline void begin_memory() noexcept {
  const uint32_t* from = __data_load;
  for (volatile uint32_t* to = __data_start; to < __data_end; ++to) *to = *from++;
  for (volatile uint32_t* to = __bss_start; to < __bss_end; ++to) *to = 0;
}

}  // namespace whisker::hal::mcu

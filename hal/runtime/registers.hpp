#pragma once

#include <stdint.h>

namespace whisker::hal::mcu {

/// The 32-bit register at this address.
inline volatile uint32_t& reg(uintptr_t address) noexcept {
  return *reinterpret_cast<volatile uint32_t*>(address);
}

}  // namespace whisker::hal::mcu

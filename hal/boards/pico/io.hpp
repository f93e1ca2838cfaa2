/// Access to the registers of the RP2040. Each has two more addresses: what is stored there sets or clears
/// bits.
#pragma once

#include "hal/boards/common/io.hpp"

namespace whisker::hal::pico {

using namespace mcu;

inline void set_bits(Address base, Register r, uint32_t bits) noexcept {
  store(base + 0x2000 + r.offset, bits);
}
inline void clear_bits(Address base, Register r, uint32_t bits) noexcept {
  store(base + 0x3000 + r.offset, bits);
}

}  // namespace whisker::hal::pico

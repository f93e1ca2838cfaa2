#pragma once

#include <stdint.h>

namespace whisker::hal::atmega1284p {

/// A register of the chip, by its address in the data space.
struct Register {
  uint16_t address;
};

inline uint8_t load(Register r) noexcept { return *reinterpret_cast<volatile uint8_t*>(r.address); }
inline void store(Register r, uint8_t value) noexcept {
  *reinterpret_cast<volatile uint8_t*>(r.address) = value;
}

/// Of a 16-bit register: the low half first, since reading it holds the high one.
inline uint16_t load(Register low, Register high) noexcept {
  const uint8_t held = load(low);
  return static_cast<uint16_t>(held | static_cast<uint16_t>(load(high)) << 8U);
}

constexpr uint8_t bit(uint8_t n) noexcept { return static_cast<uint8_t>(1U << n); }
inline bool is_set(Register r, uint8_t mask) noexcept { return (load(r) & mask) != 0; }
/// The registers that both the loop and an interrupt write are written by neither like this.
inline void set(Register r, uint8_t mask) noexcept { store(r, static_cast<uint8_t>(load(r) | mask)); }
inline void clear(Register r, uint8_t mask) noexcept { store(r, static_cast<uint8_t>(load(r) & ~mask)); }

}  // namespace whisker::hal::atmega1284p

/// Access to the registers of the chip. Every driver uses load() and store(), and names registers and bits by
/// the constants of reg/. A test compares each constant with the table of the chip's facts.
#pragma once

#include <stdint.h>

namespace whisker::hal::mcu {

using Address = uint32_t;

/// A register, by its offset from the base address of the peripheral.
struct Register {
  uint16_t offset;
};

/// Some bits of a register.
struct Field {
  uint16_t offset;
  uint8_t lsb;
  uint8_t width;
};

/// The same bits for each of several pins: those of pin n start at (n - first) * width.
struct PinField {
  uint16_t offset;
  uint8_t width;
  uint8_t first;
};

#ifdef WHISKER_REGISTER_MODELS
/// On the host, the models of the peripherals define these.
uint32_t load(Address address) noexcept;
void store(Address address, uint32_t value) noexcept;
#else
inline uint32_t load(Address address) noexcept { return *reinterpret_cast<volatile uint32_t*>(address); }
inline void store(Address address, uint32_t value) noexcept {
  *reinterpret_cast<volatile uint32_t*>(address) = value;
}
#endif

inline uint32_t load(Address base, Register r) noexcept { return load(base + r.offset); }
inline void store(Address base, Register r, uint32_t value) noexcept { store(base + r.offset, value); }

constexpr uint32_t mask(Field f) noexcept {
  return (f.width == 32 ? UINT32_MAX : (UINT32_C(1) << f.width) - 1) << f.lsb;
}
constexpr uint32_t bits(Field f, uint32_t value) noexcept { return (value << f.lsb) & mask(f); }
constexpr uint32_t value(Field f, uint32_t word) noexcept { return (word & mask(f)) >> f.lsb; }
constexpr Field of_pin(PinField f, uint8_t pin) noexcept {
  return {f.offset, static_cast<uint8_t>((pin - f.first) * f.width), f.width};
}

inline uint32_t get(Address base, Field f) noexcept { return value(f, load(base + f.offset)); }
inline bool is_set(Address base, Field f) noexcept { return get(base, f) != 0; }
/// Keeps the other bits of the register.
inline void set(Address base, Field f, uint32_t v) noexcept {
  store(base + f.offset, (load(base + f.offset) & ~mask(f)) | bits(f, v));
}

}  // namespace whisker::hal::mcu

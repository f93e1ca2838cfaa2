/// Converts values to frames and back, by the table in messages.hpp.
#pragma once

#include <stdint.h>

#include "firmware/can/e2e.hpp"
#include "firmware/can/ids.hpp"
#include "firmware/can/table.hpp"

namespace whisker::can {

/// With a signal of the table, each of these inlines to a shift and a mask.
class Packer {
 public:
  template <class T>
  [[gnu::always_inline]] void operator()(const Signal& s, const T& value) noexcept {
    bits_ |= (static_cast<uint64_t>(value) & mask(s)) << s.start;
  }
  uint64_t bits() const noexcept { return bits_; }
  static constexpr uint64_t mask(const Signal& s) noexcept { return (UINT64_C(1) << s.length) - 1; }

 private:
  uint64_t bits_ = 0;
};

class Unpacker {
 public:
  explicit Unpacker(uint64_t bits) noexcept : bits_(bits) {}
  template <class T>
  [[gnu::always_inline]] void operator()(const Signal& s, T& value) noexcept {
    const uint64_t field = (bits_ >> s.start) & Packer::mask(s);
    const int64_t sign = s.is_signed ? INT64_C(1) << (s.length - 1) : 0;
    const int64_t raw = (static_cast<int64_t>(field) ^ sign) - sign;
    if (raw < s.min || raw > s.max) sound_ = false;
    value = static_cast<T>(raw);
  }
  bool sound() const noexcept { return sound_; }

 private:
  uint64_t bits_;
  bool sound_ = true;
};

/// The data bits of a frame, byte 0 lowest.
inline uint64_t bits_of(const hal::CanFrame& frame) noexcept {
  uint32_t low = 0, high = 0;
  for (int i = 3; i >= 0; --i) {
    low = low << 8 | frame.data[i];
    high = high << 8 | frame.data[i + 4];
  }
  return static_cast<uint64_t>(high) << 32 | low;
}

/// A frame with this content and its protection.
hal::CanFrame sealed(uint64_t bits, uint32_t id, uint8_t size, uint8_t counter) noexcept;

template <class M>
hal::CanFrame encode(const M& m, uint8_t node, uint8_t counter) noexcept {
  Packer packer;
  M::each(m, packer);
  constexpr const Message& kMessage = message_of(M::kKind);
  return sealed(packer.bits(), id_of(kMessage.function, node), kMessage.size, counter);
}

/// The caller must have checked the CRC. False: a value is out of range.
template <class M>
bool decode(const hal::CanFrame& frame, M& m) noexcept {
  Unpacker unpacker{bits_of(frame)};
  M::each(m, unpacker);
  return unpacker.sound();
}

}  // namespace whisker::can

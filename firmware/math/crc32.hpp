/// CRC-32 as in Ethernet and zlib: polynomial 0x04C11DB7, reflected.
#pragma once

#include <stdint.h>

namespace whisker {

/// Without a table: 8 steps a byte.
class Crc32 {
 public:
  constexpr void add(uint8_t byte) noexcept {
    bits_ ^= byte;
    for (int i = 0; i < 8; ++i) bits_ = (bits_ >> 1) ^ ((bits_ & 1U) != 0 ? UINT32_C(0xEDB88320) : 0);
  }
  constexpr uint32_t value() const noexcept { return ~bits_; }

 private:
  uint32_t bits_ = UINT32_MAX;
};

}  // namespace whisker

/// CRC-32 as in Ethernet and zlib: polynomial 0x04C11DB7, reflected.
#pragma once

#include <stdint.h>

namespace whisker {

/// What the low half of a byte does to a CRC-32.
struct Crc32Table {
  uint32_t of[16] = {};

  constexpr Crc32Table() noexcept {
    for (uint32_t half = 0; half < 16; ++half) {
      uint32_t bits = half;
      for (int i = 0; i < 4; ++i) bits = (bits >> 1) ^ ((bits & 1U) != 0 ? UINT32_C(0xEDB88320) : 0);
      of[half] = bits;
    }
  }
};
inline constexpr Crc32Table kCrc32Table;

/// By half a byte, with a table of 64 bytes.
class Crc32 {
 public:
  constexpr void add(uint8_t byte) noexcept {
    bits_ = (bits_ >> 4) ^ kCrc32Table.of[(bits_ ^ byte) & 15U];
    bits_ = (bits_ >> 4) ^ kCrc32Table.of[(bits_ ^ byte >> 4) & 15U];
  }
  constexpr uint32_t value() const noexcept { return ~bits_; }

 private:
  uint32_t bits_ = UINT32_MAX;
};

}  // namespace whisker

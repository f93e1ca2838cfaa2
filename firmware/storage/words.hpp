/// Words of 32 bits in a record of a hal::Storage, low byte first.
#pragma once

#include <stdint.h>

#include "firmware/math/crc32.hpp"
#include "hal/storage.hpp"

namespace whisker::storage {

static_assert(hal::Storage::kGrain == 4, "a record is written word by word");

constexpr uint8_t byte_of(uint32_t word, int i) noexcept { return static_cast<uint8_t>(word >> (8 * i)); }

/// Writes the four bytes at `to`.
inline void put_word(uint8_t* to, uint32_t word) noexcept {
  for (int i = 0; i < 4; ++i) to[i] = byte_of(word, i);
}
/// Reads the four bytes at `from`.
inline uint32_t get_word(const uint8_t* from) noexcept {
  uint32_t word = 0;
  for (int i = 0; i < 4; ++i) word |= uint32_t{from[i]} << (8 * i);
  return word;
}
[[gnu::noinline]] inline void add_word(Crc32& crc, uint32_t word) noexcept {
  for (int i = 0; i < 4; ++i) crc.add(byte_of(word, i));
}
/// False: the storage does not answer.
[[gnu::noinline]] inline bool read_word(hal::Storage& storage, uint8_t slot, uint16_t word,
                                        uint32_t& value) noexcept {
  uint8_t bytes[4];
  if (!storage.read(slot, static_cast<uint16_t>(4 * word), bytes, sizeof bytes)) return false;
  value = get_word(bytes);
  return true;
}

}  // namespace whisker::storage

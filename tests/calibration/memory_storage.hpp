/// A storage in the test's memory: power fails after any byte, bits flip, and it refuses.
#pragma once

#include <array>
#include <cstdint>

#include "hal/storage.hpp"

namespace whisker::test {

class MemoryStorage final : public hal::Storage {
 public:
  bool read(std::uint8_t slot, std::uint8_t* out, std::uint8_t size) noexcept override {
    if (silent) return false;
    for (int i = 0; i < size; ++i) out[i] = slots.at(slot).at(static_cast<std::size_t>(i));
    return true;
  }
  bool write(std::uint8_t slot, const std::uint8_t* data, std::uint8_t size) noexcept override {
    if (refuses) return false;
    auto& bytes = slots.at(slot);
    if (erases) bytes.fill(0xFF);
    for (int i = 0; i < size; ++i) {
      if (power == 0) {
        bytes[static_cast<std::size_t>(i)] = torn;
        return false;
      }
      bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(data[i] & keeps);
      if (power > 0) --power;
    }
    return true;
  }

  std::array<std::array<std::uint8_t, kSlotBytes>, kSlots> slots{};
  bool silent = false;
  bool refuses = false;
  bool erases = true;         ///< a write erases the whole slot first, as flash does
  int power = -1;             ///< fails after this number of bytes; -1: never
  std::uint8_t torn = 0x5A;   ///< what the byte becomes during which the power fails
  std::uint8_t keeps = 0xFF;  ///< bits that the memory can hold
};

}  // namespace whisker::test

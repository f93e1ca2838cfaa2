/// A storage in the test's memory: power fails after any byte, bits flip, and it refuses.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal/storage.hpp"

namespace whisker::test {

class MemoryStorage final : public hal::Storage {
 public:
  explicit MemoryStorage(std::uint16_t size = kSlotBytes) {
    for (auto& slot : slots) slot.resize(size);
  }

  std::uint16_t size() const noexcept override { return static_cast<std::uint16_t>(slots[0].size()); }
  bool read(std::uint8_t slot, std::uint16_t at, std::uint8_t* out, std::uint16_t size) noexcept override {
    if (silent) return false;
    for (int i = 0; i < size; ++i) out[i] = slots.at(slot).at(static_cast<std::size_t>(at + i));
    return true;
  }
  bool erase(std::uint8_t slot) noexcept override {
    if (refuses) return false;
    for (std::uint8_t& byte : slots.at(slot)) {
      if (erase_power == 0) return false;
      if (erases) byte = 0xFF;
      if (erase_power > 0) --erase_power;
    }
    return true;
  }
  bool write(std::uint8_t slot, std::uint16_t at, const std::uint8_t* data,
             std::uint16_t size) noexcept override {
    if (refuses || at % kGrain != 0 || size % kGrain != 0) return false;
    auto& bytes = slots.at(slot);
    for (int i = 0; i < size; ++i) {
      auto& byte = bytes.at(static_cast<std::size_t>(at + i));
      if (power == 0) {
        byte = torn;
        return false;
      }
      byte = static_cast<std::uint8_t>(data[i] & keeps);
      if (power > 0) --power;
    }
    return true;
  }

  std::array<std::vector<std::uint8_t>, kSlots> slots;
  bool silent = false;
  bool refuses = false;
  bool erases = true;         ///< as flash does; otherwise old bytes stay until they are written
  int erase_power = -1;       ///< fails after this number of erased bytes; -1: never
  int power = -1;             ///< the same for written bytes
  std::uint8_t torn = 0x5A;   ///< what the byte becomes during which the power fails
  std::uint8_t keeps = 0xFF;  ///< bits that the memory can hold
};

}  // namespace whisker::test

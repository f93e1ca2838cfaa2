#pragma once

#include "hal/boards/stm32f405/io.hpp"
#include "hal/storage.hpp"

namespace whisker::hal::stm32f405 {

/// What a storage is for, by the first of its two sectors of the flash. stm32f405.ld keeps the program below
/// all of them.
enum class FlashUse : uint8_t { response_table = 8, calibration = 10 };

/// Two slots in two of the last four sectors of the flash, 128 KB each. The chip runs from the same flash, so
/// it stands still while it erases, for 2 s at most: only while the wheels stand. Once the watchdog runs,
/// through WatchedStorage. Needs 2.7 V or more.
class FlashStorage final : public Storage {
 public:
  static constexpr uint16_t kSize = 8192;

  explicit FlashStorage(FlashUse use) noexcept : first_sector_(static_cast<uint8_t>(use)) {}

  uint16_t size() const noexcept override { return kSize; }
  /// False: beyond the end of the slot.
  bool read(uint8_t slot, uint16_t at, uint8_t* out, uint16_t size) noexcept override;
  bool erase(uint8_t slot) noexcept override;
  bool write(uint8_t slot, uint16_t at, const uint8_t* data, uint16_t size) noexcept override;

 private:
  const uint8_t first_sector_;
};

}  // namespace whisker::hal::stm32f405

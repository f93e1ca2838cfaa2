#pragma once

#include "hal/boards/pico/watchdog.hpp"
#include "hal/storage.hpp"

namespace whisker::hal::pico {

/// What a storage is for. pico.ld keeps the program below all of them.
enum class FlashUse : uint8_t { response_table, calibration, parameters };
constexpr uint8_t kFlashUses = 3;

/// Two slots of two sectors each, at the end of the flash. The chip runs from the same flash, so it stands
/// still while it erases, for 0.1 s and at most 0.8 s, and no interrupt is handled: only while the wheels
/// stand.
class FlashStorage final : public Storage {
 public:
  static constexpr uint16_t kSize = 8192;
  static constexpr uint8_t kIdBytes = 8;

  /// The number that the maker of the flash chip gave it: no other chip has it. Takes 0.1 ms.
  static void read_id(uint8_t (&id)[kIdBytes]) noexcept;

  /// The watchdog, if it runs, waits for an erasure.
  FlashStorage(FlashUse use, Watchdog& watchdog) noexcept : use_(use), watchdog_(watchdog) {}
  /// The watchdog runs from now on, with this time-out.
  void start(uint32_t watchdog_ms) noexcept { watchdog_ms_ = watchdog_ms; }

  uint16_t size() const noexcept override { return kSize; }
  /// False: beyond the end of the slot.
  bool read(uint8_t slot, uint16_t at, uint8_t* out, uint16_t size) noexcept override;
  bool erase(uint8_t slot) noexcept override;
  bool write(uint8_t slot, uint16_t at, const uint8_t* data, uint16_t size) noexcept override;

 private:
  const FlashUse use_;
  Watchdog& watchdog_;
  uint32_t watchdog_ms_ = 0;  // 0: it does not run
};

}  // namespace whisker::hal::pico

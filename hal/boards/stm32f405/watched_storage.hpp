#pragma once

#include "hal/boards/stm32f405/flash_storage.hpp"
#include "hal/boards/stm32f405/watchdog.hpp"

namespace whisker::hal::stm32f405 {

/// The flash storage of a board whose watchdog runs. An erasure gets a longer time-out, because nothing can
/// feed the watchdog meanwhile.
class WatchedStorage final : public Storage {
 public:
  /// Even if the watchdog's oscillator is as fast as the data sheet allows, 47 kHz, it waits 2.7 s.
  static constexpr uint16_t kErasureMs = 4095;

  /// Both must outlive it.
  WatchedStorage(FlashUse use, Watchdog& watchdog, Troubles& troubles) noexcept
      : flash_(use), watchdog_(watchdog), troubles_(troubles) {}
  /// The watchdog runs from now on, with this time-out. Before, an erasure does not start it.
  void start(const Clocks& clocks, uint16_t watchdog_ms) noexcept;

  uint16_t size() const noexcept override { return flash_.size(); }
  bool read(uint8_t slot, uint16_t at, uint8_t* out, uint16_t size) noexcept override;
  /// Blocks for 2.1 s at most if the flash keeps its data sheet's time.
  bool erase(uint8_t slot) noexcept override;
  /// Feeds the watchdog: the words of a whole slot take 0.2 s at most.
  bool write(uint8_t slot, uint16_t at, const uint8_t* data, uint16_t size) noexcept override;

 private:
  FlashStorage flash_;
  Watchdog& watchdog_;
  Troubles& troubles_;
  Clocks clocks_{};
  uint16_t watchdog_ms_ = 0;  // 0: it does not run
};

}  // namespace whisker::hal::stm32f405

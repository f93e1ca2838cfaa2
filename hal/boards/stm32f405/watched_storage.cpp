#include "hal/boards/stm32f405/watched_storage.hpp"

namespace whisker::hal::stm32f405 {

void WatchedStorage::start(const Clocks& clocks, uint16_t watchdog_ms) noexcept {
  clocks_ = clocks;
  watchdog_ms_ = watchdog_ms;
}

bool WatchedStorage::read(uint8_t slot, uint16_t at, uint8_t* out, uint16_t size) noexcept {
  return flash_.read(slot, at, out, size);
}

bool WatchedStorage::erase(uint8_t slot) noexcept {
  if (watchdog_ms_ == 0) return flash_.erase(slot);
  const bool longer = watchdog_.start(kErasureMs, clocks_, troubles_);
  const bool erased = longer && flash_.erase(slot);
  watchdog_.start(watchdog_ms_, clocks_, troubles_);
  return erased;
}

bool WatchedStorage::write(uint8_t slot, uint16_t at, const uint8_t* data, uint16_t size) noexcept {
  if (watchdog_ms_ != 0) watchdog_.feed();
  return flash_.write(slot, at, data, size);
}

}  // namespace whisker::hal::stm32f405

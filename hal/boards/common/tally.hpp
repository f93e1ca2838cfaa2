#pragma once

#include <stdint.h>

namespace whisker::hal::mcu {

/// Number of occurrences of each failure of a board; the counters saturate. For the main loop only:
/// interrupts count with Events. `Trouble`: an enumeration from 0 to kCount - 1.
template <class Trouble, uint8_t kCount>
class Tally {
 public:
  void count(Trouble trouble, uint16_t times = 1) noexcept {
    uint16_t& counter = count_[static_cast<uint8_t>(trouble)];
    counter = static_cast<uint16_t>(counter > UINT16_MAX - times ? UINT16_MAX : counter + times);
  }
  uint16_t of(Trouble trouble) const noexcept { return count_[static_cast<uint8_t>(trouble)]; }
  uint32_t total() const noexcept {
    uint32_t sum = 0;
    for (const uint16_t counter : count_) sum += counter;
    return sum;
  }

 private:
  uint16_t count_[kCount] = {};
};

}  // namespace whisker::hal::mcu

#pragma once

#include <algorithm>

#include "hal/boards/stm32f405/reg/iwdg.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

/// Its values are writable only while unlocked, and take effect after a delay.
class IwdgModel : public Peripheral {
 public:
  IwdgModel() { word(iwdg::kRlr.offset) = 0xFFF; }

  void store(std::uint32_t offset, std::uint32_t value) override {
    if (offset == iwdg::kKr.offset) {
      if (value == 0xCCCC) running = true;
      if (value == 0xAAAA) {
        ++feedings;
        hungry_us_ = 0;
        loaded_ms_ = timeout_ms();
      }
      unlocked_ = value == 0x5555;
      return;
    }
    const Field busy = offset == iwdg::kPr.offset ? iwdg::kPvu : iwdg::kRvu;
    if (!unlocked_ || get(busy) != 0) return;
    word(offset) = value;
    put(busy, 1);
    left_ = 200;
  }
  void advance() override {
    if (running) {
      hungry_us_ += Chip::kUsPerAccess;
      hungriest = std::max(hungriest, hungry_us_ / (1000 * loaded_ms_));
    }
    if (!running || never_ready || left_ == 0 || --left_ > 0) return;
    put(iwdg::kPvu, 0);
    put(iwdg::kRvu, 0);
  }
  double timeout_ms() { return (word(iwdg::kRlr.offset) + 1.0) * (4 << word(iwdg::kPr.offset)) / 32.0; }

  bool running = false;
  int feedings = 0;
  double hungriest = 0;  ///< largest part of the time-out that passed without a feeding
  bool never_ready = false;

 private:
  bool unlocked_ = false;
  int left_ = 0;
  double hungry_us_ = 0;
  double loaded_ms_ = 512;
};

}  // namespace whisker::hal::stm32f405::model

#pragma once

#include <deque>
#include <string>

#include "hal/boards/stm32f405/reg/usart.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

class UsartModel : public Peripheral {
 public:
  static constexpr int kByte = 40;  // polls

  UsartModel() { word(usart::kSr.offset) = mask(usart::kTxe); }

  std::uint32_t load(std::uint32_t offset) override {
    if (offset == usart::kSr.offset) status_read_ = true;
    if (offset != usart::kDr.offset) return word(offset);
    if (status_read_) {
      put(usart::kOre, 0);
      put(usart::kFe, 0);
      put(usart::kNf, 0);
    }
    status_read_ = false;
    put(usart::kRxne, 0);
    return received_;
  }
  void store(std::uint32_t offset, std::uint32_t value) override {
    if (offset != usart::kDr.offset) {
      word(offset) = value;
      return;
    }
    if (get(usart::kTxe) == 0 || get(usart::kTe) == 0 || get(usart::kUe) == 0) return;
    sent += static_cast<char>(value);
    put(usart::kTxe, 0);
    left_ = kByte;
  }
  void advance() override {
    if (!line_held && left_ > 0 && --left_ == 0) put(usart::kTxe, 1);
  }
  /// A byte arrives. Returns whether the interrupt is raised.
  bool receive(std::uint8_t byte, bool noisy = false) {
    if (get(usart::kRe) == 0 || get(usart::kUe) == 0) return false;
    if (get(usart::kRxne) != 0) {
      put(usart::kOre, 1);
    } else {
      received_ = byte;
      put(usart::kRxne, 1);
      put(usart::kNf, noisy ? 1 : 0);
    }
    return get(usart::kRxneie) != 0;
  }
  double baud(double clock_hz) {
    return clock_hz / (16 * (get(usart::kMantissa) + get(usart::kFraction) / 16.0));
  }

  std::string sent;
  bool line_held = false;  // sent bytes do not leave

 private:
  bool status_read_ = false;
  std::uint32_t received_ = 0;
  int left_ = 0;
};

}  // namespace whisker::hal::stm32f405::model

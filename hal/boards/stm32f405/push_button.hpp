#pragma once

#include "hal/boards/common/press_detector.hpp"
#include "hal/button.hpp"

namespace whisker::hal::stm32f405 {

/// The button wiring::kButton, which closes its pin to ground. A pin without a button reports nothing.
class PushButton final : public Button {
 public:
  /// Call it as often as possible, and at least every 5 ms.
  void poll(uint32_t now_ms) noexcept;
  Press take() noexcept override { return presses_.take(); }

 private:
  mcu::PressDetector presses_;
};

}  // namespace whisker::hal::stm32f405

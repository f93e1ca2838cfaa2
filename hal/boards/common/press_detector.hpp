#pragma once

#include <stdint.h>

#include "hal/boards/common/debounce.hpp"
#include "hal/button.hpp"

namespace whisker::hal::mcu {

/// Tells the presses of a button from the state of its contacts: see hal::Button.
class PressDetector {
 public:
  static constexpr uint32_t kBriefMs = 50;
  static constexpr uint32_t kHeldMs = 1000;

  /// The state of the contacts now. Call it at least every 5 ms.
  void sample(bool closed, uint32_t now_ms) noexcept {
    switch_.sample(closed, now_ms);
    const bool down = switch_.take();
    const uint32_t passed = now_ms - since_ms_;
    if (down && !down_) {
      since_ms_ = now_ms;
    } else if (down && !reported_ && passed >= kHeldMs) {
      report(Press::held);
    } else if (!down) {
      // A contact counts as closed for kOpenMs after its end.
      if (down_ && !reported_ && passed >= kBriefMs + Debounce::kOpenMs) report(Press::brief);
      reported_ = false;
    }
    down_ = down;
  }
  Press take() noexcept {
    const Press press = press_;
    press_ = Press::none;
    return press;
  }

 private:
  void report(Press press) noexcept {
    press_ = press;
    reported_ = true;
  }

  Debounce switch_;
  uint32_t since_ms_ = 0;
  Press press_ = Press::none;
  bool down_ = false;
  bool reported_ = true;  // this press, or the button has been down since the start
};

}  // namespace whisker::hal::mcu

#pragma once

#include <stdint.h>

namespace whisker::hal::mcu {

/// A switch whose contacts bounce. Closed counts at once; open counts after kOpenMs without a break, and not
/// before take() has returned the press.
class Debounce {
 public:
  static constexpr uint32_t kOpenMs = 20;

  /// The state of the contacts now. Call it at least every 5 ms.
  void sample(bool closed, uint32_t now_ms) noexcept {
    if (closed) {
      pressed_ = fresh_ = true;
      closed_ms_ = now_ms;
    } else if (now_ms - closed_ms_ >= kOpenMs) {
      pressed_ = false;
    }
  }
  /// Pressed now, or at some moment since the last call.
  bool take() noexcept {
    const bool pressed = pressed_ || fresh_;
    fresh_ = false;
    return pressed;
  }

 private:
  bool pressed_ = false;
  bool fresh_ = false;
  uint32_t closed_ms_ = 0;
};

}  // namespace whisker::hal::mcu

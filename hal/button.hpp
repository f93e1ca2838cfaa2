#pragma once

#include <stdint.h>

namespace whisker::hal {

enum class Press : uint8_t {
  none,
  brief,  ///< let go within a second
  held,   ///< down for a second, and perhaps still
};

/// A push button for a person; optional.
///
/// The driver debounces. It reports each press once: a brief one when the button is let go, a held one after
/// a second. A contact shorter than 50 ms is a disturbance, and a button that is down at the start is none
/// that a person pressed: neither is reported.
class Button {
 public:
  /// The press since the last call; of several, the last one. Never blocks.
  virtual Press take() noexcept = 0;

 protected:
  ~Button() = default;
};

}  // namespace whisker::hal

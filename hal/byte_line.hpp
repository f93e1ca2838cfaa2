#pragma once

#include <stddef.h>
#include <stdint.h>

namespace whisker::hal {

/// An ordered byte channel to another machine. No call blocks.
class ByteLine {
 public:
  /// Copies up to `room` received bytes. Returns their number; 0: none now.
  virtual size_t take(uint8_t* to, size_t room) noexcept = 0;
  /// Sends up to `count` bytes. Returns the number accepted; 0: no room now.
  virtual size_t offer(const uint8_t* from, size_t count) noexcept = 0;
  /// Whether the other end is connected, as far as the line can tell. False at least once after each
  /// disconnection, which discards all bytes in transit. May try to reconnect.
  virtual bool ready() noexcept = 0;

 protected:
  ~ByteLine() = default;
};

}  // namespace whisker::hal

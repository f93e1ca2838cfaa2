#pragma once

#include <stddef.h>
#include <stdint.h>

namespace whisker::hal {

/// Bytes to and from another machine, in order. No call waits.
class ByteLine {
 public:
  /// Up to `room` of the bytes that have come. Returns how many; 0: none now.
  virtual size_t take(uint8_t* to, size_t room) noexcept = 0;
  /// Hands over up to `count` bytes. Returns how many were taken; 0: no room now.
  virtual size_t offer(const uint8_t* from, size_t count) noexcept = 0;
  /// Whether there is another end, as far as the line can tell. False at least once after each loss of it,
  /// with which all that was under way is lost. May look for it again.
  virtual bool ready() noexcept = 0;

 protected:
  ~ByteLine() = default;
};

}  // namespace whisker::hal

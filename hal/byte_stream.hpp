#pragma once

#include <stddef.h>
#include <stdint.h>

namespace whisker::hal {

/// Bytes to and from a companion computer, in order and without loss. Not for the control loop of a real
/// robot: both calls wait.
class ByteStream {
 public:
  /// Waits until all have come. False: the stream has ended or failed, and stays so.
  virtual bool read(uint8_t* to, size_t count) noexcept = 0;
  /// Waits until all are taken. False: the stream has failed, and stays so.
  virtual bool write(const uint8_t* from, size_t count) noexcept = 0;

 protected:
  ~ByteStream() = default;
};

}  // namespace whisker::hal

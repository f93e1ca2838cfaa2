#pragma once

#include <stddef.h>
#include <stdint.h>

namespace whisker::hal {

/// An ordered and lossless byte channel to the computer that runs the emulator. Not for the control loop of a
/// real robot, because both calls block.
class ByteStream {
 public:
  /// Blocks until all bytes have arrived. False: the stream has ended or failed permanently.
  virtual bool read(uint8_t* to, size_t count) noexcept = 0;
  /// Blocks until all bytes are accepted. False: the stream has failed permanently.
  virtual bool write(const uint8_t* from, size_t count) noexcept = 0;

 protected:
  ~ByteStream() = default;
};

}  // namespace whisker::hal

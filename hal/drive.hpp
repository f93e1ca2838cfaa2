#pragma once

#include "hal/types.hpp"

namespace whisker::hal {

/// Two driven wheels with encoders. The core calls each function once a control tick.
class Drive {
 public:
  /// Sets both wheels' speeds; they hold until the next call. Never blocks.
  /// False: the drive stage refused; the core counts it, commands zero, and after a few
  /// refusals in a row stops for good with a named fault.
  virtual bool command(WheelSpeeds speeds) noexcept = 0;

  /// Copies both encoders' counts. Never blocks. False: no counts; `out` is untouched.
  virtual bool read(EncoderCounts& out) noexcept = 0;

 protected:
  ~Drive() = default;
};

}  // namespace whisker::hal

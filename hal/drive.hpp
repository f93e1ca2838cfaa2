#pragma once

#include "hal/types.hpp"

namespace whisker::hal {

/// Two driven wheels with encoders. The core calls each function once per control tick.
class Drive {
 public:
  /// Sets the speeds of both wheels; they hold until the next call. Never blocks. False: the drive refused.
  /// The core counts it, commands zero, and after a few refusals close to one another stops with a named
  /// fault.
  virtual bool command(WheelSpeeds speeds) noexcept = 0;

  /// Copies the counts of both encoders. Never blocks. False: no counts; `out` is unchanged.
  virtual bool read(EncoderCounts& out) noexcept = 0;

 protected:
  ~Drive() = default;
};

}  // namespace whisker::hal

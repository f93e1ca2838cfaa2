#pragma once

#include "hal/types.hpp"

namespace whisker::hal {

/// Bump switches at the front half of the body; optional. The core calls read() once per control tick.
///
/// The driver debounces: it reports a press at the first contact, at most 5 ms late, and a release only after
/// the switch has been open for 20 ms without a break and read() has returned the press. So every press is
/// seen at some tick. A driver that cannot tell the state of its switches, for example because their wire is
/// broken, returns false.
class Bumper {
 public:
  /// Copies the state of all switches. Never blocks. False: no state; `out` is unchanged. The core counts it
  /// and keeps the last state; after a few refusals close to one another it stops with a named fault.
  virtual bool read(BumperReading& out) noexcept = 0;

 protected:
  ~Bumper() = default;
};

}  // namespace whisker::hal

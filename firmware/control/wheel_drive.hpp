/// The only way to the wheels.
#pragma once

#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"
#include "hal/drive.hpp"

namespace whisker::control {

/// Holds the drive, and knows what its wheels do: as commanded last, and as they turn by now behind their
/// motors' lag.
class WheelDrive {
 public:
  /// The drive must outlive it.
  explicit WheelDrive(hal::Drive& drive) noexcept : drive_(drive) {}

  bool read(hal::EncoderCounts& counts) noexcept { return drive_.read(counts); }
  /// Commands these speeds, `elapsed` since the last ones. False: the drive refused; the wheels count as
  /// commanded to stand.
  bool command(WheelPair speeds, Duration elapsed, const Params& params) noexcept;

  WheelState state() const noexcept { return {commanded_, rolling_}; }
  /// As given to the drive; zero where it refused.
  hal::WheelSpeeds sent() const noexcept { return sent_; }

 private:
  hal::Drive& drive_;
  WheelPair commanded_;
  WheelPair rolling_;
  hal::WheelSpeeds sent_{};
};

/// To the wire's 0.1 mm/s, to nearest; saturates.
hal::WheelSpeeds to_wire(WheelPair speeds) noexcept;

}  // namespace whisker::control

/// The only access to the wheels.
#pragma once

#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"
#include "hal/drive.hpp"

namespace whisker::control {

/// Holds the drive and the state of its wheels.
class WheelDrive {
 public:
  /// The drive must outlive it.
  explicit WheelDrive(hal::Drive& drive) noexcept : drive_(drive) {}

  bool read(hal::EncoderCounts& counts) noexcept { return drive_.read(counts); }
  /// Once per tick, before all else: the wheels followed the last command for this time.
  void pass(Duration elapsed, const Params& params) noexcept;
  /// What the body ran into stops the wheels.
  void halt() noexcept { state_.reached = {}; }
  /// False: the drive refused, and the wheels count as commanded to stand.
  bool command(WheelPair speeds) noexcept;

  const WheelState& state() const noexcept { return state_; }
  /// As sent to the drive; zero if it refused.
  hal::WheelSpeeds sent() const noexcept { return sent_; }

 private:
  hal::Drive& drive_;
  WheelState state_;
  hal::WheelSpeeds sent_{};
};

/// Converts to the HAL's unit of 0.1 mm/s, rounded to nearest; saturates.
hal::WheelSpeeds to_wire(WheelPair speeds) noexcept;
/// Not both of them round to zero.
bool turns_on_wire(WheelPair speeds) noexcept;

}  // namespace whisker::control

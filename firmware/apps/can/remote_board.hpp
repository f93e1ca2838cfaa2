#pragma once

#include "firmware/can/input_set.hpp"
#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::can_app {

/// Rangefinders, bump switches and wheels at the other end of a bus: they return the values of the last input
/// set.
class RemoteBoard final : public hal::Rangefinders, public hal::Bumper, public hal::Drive {
 public:
  /// braked: the wheels braked without the core's knowledge, so its next command is refused once, and it
  /// starts again from standstill.
  void on_frame(const can::InputSet& set, bool braked) noexcept {
    set_ = set;
    braked_ = braked;
  }

  bool read(hal::RangeReadings& out) noexcept override {
    out = set_.ranges;
    return true;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    if (set_.counts_valid) out = set_.counts;
    return set_.counts_valid;
  }
  bool read(hal::BumperReading& out) noexcept override {
    hal::BumperReading reading{};
    for (int i = 0; i < hal::kBeams; ++i) {
      if (set_.bumps[i] == can::BumpState::none || set_.bumps[i] == can::BumpState::unknown) return false;
      if (set_.bumps[i] == can::BumpState::pressed)
        reading.pressed = static_cast<uint8_t>(reading.pressed | 1U << i);
    }
    out = reading;
    return true;
  }
  bool command(hal::WheelSpeeds) noexcept override { return !braked_; }

 private:
  can::InputSet set_;
  bool braked_ = false;
};

}  // namespace whisker::can_app

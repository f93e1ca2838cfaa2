#pragma once

#include "firmware/can/input_set.hpp"
#include "hal/drive.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::can_app {

/// Rangefinders and wheels at the other end of a bus: they return the values of the last input set.
class RemoteBoard final : public hal::Rangefinders, public hal::Drive {
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
  bool command(hal::WheelSpeeds) noexcept override { return !braked_; }

 private:
  can::InputSet set_;
  bool braked_ = false;
};

}  // namespace whisker::can_app

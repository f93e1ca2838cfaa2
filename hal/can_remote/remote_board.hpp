#pragma once

#include "firmware/can/input_set.hpp"
#include "hal/drive.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::can_remote {

/// Rangefinders and wheels at the other end of a bus: they say what the last input set said.
///
/// After a safe stop the counts have gone on by the way of braking, further than the core's odometry takes in
/// one tick: it gets them in pieces.
class RemoteBoard final : public hal::Rangefinders, public hal::Drive {
 public:
  /// braked: the wheels were braked without the core's knowledge, so its next command is refused once, and it
  /// begins anew from a stand.
  void hear(const can::InputSet& set, bool braked) noexcept {
    const hal::EncoderCounts before = set_.counts;
    set_ = set;
    braked_ = braked;
    if (catching_up_ && set.counts_valid) set_.counts = nearer(before, set.counts);
    if (!set.counts_valid) set_.counts = before;
  }
  /// The next sets come after a pause. most: counts of a wheel in one tick.
  void resume(uint32_t most) noexcept {
    most_ = most;
    pieces_ = 0;
    catching_up_ = true;
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
  static constexpr int kMostPieces = 10;  // a longer way is no braking

  hal::EncoderCounts nearer(const hal::EncoderCounts& from, const hal::EncoderCounts& to) noexcept;

  can::InputSet set_;
  uint32_t most_ = 0;
  int pieces_ = 0;
  bool catching_up_ = false;
  bool braked_ = false;
};

}  // namespace whisker::can_remote

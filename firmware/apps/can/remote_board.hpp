#pragma once

#include "firmware/can/input_set.hpp"
#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/gyro.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::can_app {

/// Rangefinders, bump switches, gyro and wheels at the other end of a bus: they return the values of the last
/// input set.
class RemoteBoard final : public hal::Rangefinders, public hal::Bumper, public hal::Gyro, public hal::Drive {
 public:
  /// braked: the wheels braked without the core's knowledge, so its next command is refused once, and it
  /// starts again from standstill.
  void on_frame(const can::InputSet& set, bool braked) noexcept {
    set_ = set;
    braked_ = braked;
    if (set.gyro_valid) continue_sums(set.gyro);
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
  bool read(hal::GyroReading& out) noexcept override {
    if (set_.gyro_valid) out = gyro_;
    return set_.gyro_valid;
  }
  bool command(hal::WheelSpeeds) noexcept override { return !braked_; }

 private:
  /// A frame has the low bits of the sums. The core follows at most 255 samples from one reading to the next,
  /// and their sum is less than half of 2^24.
  void continue_sums(const hal::GyroReading& low) noexcept {
    const uint32_t sum = (low.sum - gyro_.sum) << 8;
    gyro_.sum += static_cast<uint32_t>(as_signed(sum) / 256);
    gyro_.samples = low.samples;
    gyro_.saturated =
        static_cast<uint16_t>(gyro_.saturated + static_cast<uint8_t>(low.saturated - gyro_.saturated));
  }

  can::InputSet set_;
  hal::GyroReading gyro_{};
  bool braked_ = false;
};

}  // namespace whisker::can_app

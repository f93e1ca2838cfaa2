/// All measurements of the base at one tick.
#pragma once

#include <stdint.h>

#include "firmware/can/fix.hpp"
#include "firmware/can/messages.hpp"

namespace whisker::can {

struct InputSet {
  uint32_t tick = 0;
  uint8_t period_ms = 10;
  hal::RangeReadings ranges{};
  hal::EncoderCounts counts{};
  bool counts_valid = false;
  BumpState bumps[hal::kBeams] = {};
  bool has_gyro = false;
  bool gyro_valid = false;
  hal::GyroReading gyro{};  ///< of a received set: only the bits of GyroState
  bool has_fix = false;
  localization::UncertainPose fix{};  ///< true at this tick
};

/// Assembles the frames of a tick. Frames may arrive in any order; the latest of each kind counts.
class InputSets {
 public:
  /// The reading in the form of the HAL. False: status and distance contradict each other.
  static bool sound(hal::RangeReading& wire) noexcept;
  /// The reading in the form of the frame.
  static hal::RangeReading to_wire(const hal::RangeReading& reading) noexcept;

  void on_frame(int beam, const hal::RangeReading& reading, uint16_t tick, BumpState bump) noexcept;
  void on_frame(const WheelState& state) noexcept;
  void on_frame(const GyroState& state) noexcept;
  /// False: a value is out of its range.
  bool on_frame(const FixValue& part) noexcept { return fix_.on_frame(part); }
  void on_frame(const Sync& sync) noexcept;
  /// All frames of the last Sync's tick have arrived: five, and those that Sync announces.
  bool complete() const noexcept;
  /// Only when complete().
  InputSet set() const noexcept;
  void forget() noexcept { *this = InputSets{}; }

 private:
  hal::RangeReadings ranges_{};
  uint16_t range_tick_[hal::kBeams] = {};
  BumpState bumps_[hal::kBeams] = {};
  WheelState wheels_;
  GyroState gyro_;
  FixParts fix_;
  Sync sync_;
  uint8_t seen_ = 0;
};

}  // namespace whisker::can

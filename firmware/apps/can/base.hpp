#pragma once

#include <stdint.h>

#include "firmware/can/base_node.hpp"
#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/gyro.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::can_app {

/// Sensors and wheels as a node of the bus.
///
///   every millisecond:  base.node().poll(now);
///   every period:       base.drive();  base.measure(tick++, period);  base.publish(SyncMode::real_time);
class Base {
 public:
  /// bumper, gyro: null without one.
  Base(can::BaseNode& node, hal::Rangefinders& rangefinders, hal::Drive& drive, hal::Bumper* bumper = nullptr,
       hal::Gyro* gyro = nullptr) noexcept
      : node_(node), rangefinders_(rangefinders), drive_(drive), bumper_(bumper), gyro_(gyro) {}

  /// A pose measured outside of the robot, which is true at the next measure(): the controller gets it with
  /// that set, and answers node().replied(). It gets lost with its set.
  void correct(const localization::UncertainPose& fix) noexcept {
    fix_ = fix;
    has_fix_ = true;
  }
  /// Sets the measurements of a tick to the current values of the hardware.
  void measure(uint32_t tick, uint8_t period_ms) noexcept {
    set_ = {};
    set_.tick = tick;
    set_.period_ms = period_ms;
    const bool asked = rangefinders_.read(set_.ranges);
    for (hal::RangeReading& reading : set_.ranges.beam) {
      if (!asked) reading.status = hal::RangeStatus::invalid;
    }
    set_.counts_valid = drive_.read(set_.counts);
    if (bumper_ != nullptr) measure_bumps();
    set_.has_gyro = gyro_ != nullptr;
    set_.gyro_valid = set_.has_gyro && gyro_->read(set_.gyro);
    set_.has_fix = has_fix_;
    set_.fix = fix_;
    has_fix_ = false;
    report(can::Error::sensors_refused, !asked);
    report(can::Error::gyro_refused, set_.has_gyro && !set_.gyro_valid);
  }
  /// Sends the set; in lockstep, repeats it as needed.
  bool publish(can::SyncMode sync_mode) noexcept { return node_.send_set(set_, sync_mode); }
  /// Commands the wheel speeds until the next call.
  hal::WheelSpeeds drive() noexcept {
    const hal::WheelSpeeds speeds = node_.control();
    report(can::Error::drive_refused, !drive_.command(speeds));
    return speeds;
  }
  can::BaseNode& node() noexcept { return node_; }

 private:
  void measure_bumps() noexcept {
    hal::BumperReading reading{};
    const bool read = bumper_->read(reading);
    for (int i = 0; i < hal::kBeams; ++i) {
      const bool pressed = (reading.pressed >> i & 1U) != 0;
      set_.bumps[i] = !read     ? can::BumpState::unknown
                      : pressed ? can::BumpState::pressed
                                : can::BumpState::open;
    }
  }
  void report(uint16_t bit, bool on) noexcept {
    trouble_ = static_cast<uint16_t>(on ? trouble_ | bit : trouble_ & ~bit);
    node_.report(trouble_, 0);
  }

  can::BaseNode& node_;
  hal::Rangefinders& rangefinders_;
  hal::Drive& drive_;
  hal::Bumper* bumper_;
  hal::Gyro* gyro_;
  can::InputSet set_;
  localization::UncertainPose fix_{};
  bool has_fix_ = false;
  uint16_t trouble_ = 0;
};

}  // namespace whisker::can_app

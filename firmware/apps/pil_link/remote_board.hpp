#pragma once

#include "firmware/apps/pil_link/message.hpp"
#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/gyro.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::link {

/// Sensors and wheels that a companion simulates: every call returns the values of its last message.
class RemoteBoard final : public hal::Rangefinders, public hal::Bumper, public hal::Drive {
 public:
  void on_frame(const Tick& tick) noexcept { tick_ = tick; }

  bool read(hal::RangeReadings& out) noexcept override {
    if (tick_.ranges_given != 0) out = tick_.ranges;
    return tick_.ranges_given != 0;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    if (tick_.counts_given != 0) out = tick_.counts;
    return tick_.counts_given != 0;
  }
  bool read(hal::BumperReading& out) noexcept override {
    if (tick_.bumps_given != 0) out = tick_.bumps;
    return tick_.bumps_given != 0;
  }
  bool command(hal::WheelSpeeds) noexcept override { return tick_.accepts != 0; }

 private:
  Tick tick_;
};

/// The gyro that a companion simulates.
class RemoteGyro final : public hal::Gyro {
 public:
  void on_frame(const GyroSums& gyro) noexcept {
    reading_ = gyro.reading;
    answers_ = true;
  }
  /// From now on it does not answer.
  void forget() noexcept { answers_ = false; }

  bool read(hal::GyroReading& out) noexcept override {
    if (answers_) out = reading_;
    return answers_;
  }

 private:
  hal::GyroReading reading_{};
  bool answers_ = false;
};

}  // namespace whisker::link

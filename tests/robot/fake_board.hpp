/// A board whose wheels follow every command at once; the test sets its readings.
#pragma once

#include <cmath>
#include <cstdint>

#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::test {

class FakeBoard final : public hal::Rangefinders, public hal::Bumper, public hal::Drive {
 public:
  FakeBoard() {
    for (hal::RangeReading& r : shown.beam) r = {0, hal::RangeStatus::clear, 10, 0};
  }
  /// Advances by 10 ms: the wheels roll, and every second call gives new readings.
  void pass() {
    const double v[2] = {command_.left * 1e-4, command_.right * 1e-4};
    for (int w = 0; w < 2; ++w) {
      if (!wheels_blocked) way_[w] += v[w] * 0.01;
    }
    if (++ticks_ % 2 == 0 && !frozen) {
      for (hal::RangeReading& r : shown.beam) r.sequence = static_cast<std::uint8_t>((r.sequence + 1) % 16);
    }
  }
  void show(hal::Beam beam, hal::RangeStatus status, std::uint16_t mm = 0) {
    shown.beam[beam].status = status;
    shown.beam[beam].mm = mm;
  }
  double x() const { return (way_[0] + way_[1]) / 2; }
  hal::WheelSpeeds commanded() const { return command_; }

  bool read(hal::RangeReadings& out) noexcept override {
    if (ranges_refuse) return false;
    out = shown;
    return true;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    if (counts_refuse) return false;
    out = {count(way_[swapped ? 1 : 0] + jump), count(way_[swapped ? 0 : 1] + jump)};
    return true;
  }
  bool read(hal::BumperReading& out) noexcept override {
    if (bumper_refuses) return false;
    out.pressed = pressed;
    return true;
  }
  bool command(hal::WheelSpeeds speeds) noexcept override {
    ++commands;
    if (drive_refuses) {
      command_ = {};
      return false;
    }
    command_ = speeds;
    return true;
  }

  hal::RangeReadings shown{};
  bool frozen = false;  ///< no new readings
  bool ranges_refuse = false;
  bool counts_refuse = false;
  bool drive_refuses = false;
  bool wheels_blocked = false;
  bool swapped = false;      ///< the counts of the two wheels are exchanged
  double jump = 0;           ///< metres, added to both encoders
  std::uint8_t pressed = 0;  ///< bump switches
  bool bumper_refuses = false;
  int commands = 0;

 private:
  static std::uint32_t count(double way) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(way * 5000)) & 0xFFFFFF);
  }
  hal::WheelSpeeds command_{};
  double way_[2] = {0, 0};
  int ticks_ = 0;
};

}  // namespace whisker::test

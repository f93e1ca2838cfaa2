/// A board whose wheels follow every command at once; the test sets its readings.
#pragma once

#include <cmath>
#include <cstdint>

#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/gyro.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::test {

class FakeBoard final : public hal::Rangefinders, public hal::Bumper, public hal::Gyro, public hal::Drive {
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
    add_sample(gyro_turns_too_much * (turned() - sampled_));
    sampled_ = turned();
    if (++ticks_ % 2 == 0 && !frozen) {
      for (hal::RangeReading& r : shown.beam) r.sequence = static_cast<std::uint8_t>((r.sequence + 1) % 16);
    }
  }
  void show(hal::Beam beam, hal::RangeStatus status, std::uint16_t mm = 0) {
    shown.beam[beam].status = status;
    shown.beam[beam].mm = mm;
  }
  double x() const { return (way_[0] + way_[1]) / 2; }
  double turned() const { return (way_[1] - way_[0]) / 0.14; }  ///< rad
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
  bool read(hal::GyroReading& out) noexcept override {
    ++gyro_reads;
    if (gyro_answers) out = gyro_;
    return gyro_answers;
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
  bool gyro_answers = true;
  double gyro_turns_too_much = 1;
  int gyro_bias = 0;  ///< units of a sample
  int gyro_reads = 0;
  int commands = 0;

 private:
  void add_sample(double turn) {
    const double units = std::floor(turn / 0.01 / (8.726646 / 32768) + 0.5) + gyro_bias;
    gyro_.sum += static_cast<std::uint32_t>(static_cast<std::int32_t>(units));
    ++gyro_.samples;
  }
  static std::uint32_t count(double way) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(way * 5000)) & 0xFFFFFF);
  }
  hal::WheelSpeeds command_{};
  double way_[2] = {0, 0};
  hal::GyroReading gyro_{};
  double sampled_ = 0;
  int ticks_ = 0;
};

}  // namespace whisker::test

/// The HAL of the core: what the simulator said last.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/gyro.hpp"
#include "hal/rangefinders.hpp"
#include "host/harness/socket/request.hpp"

namespace whisker::socket {

class Board final : public hal::Rangefinders, public hal::Drive, public hal::Bumper, public hal::Gyro {
 public:
  void take(const Tick& tick, std::uint32_t now_ms) noexcept {
    tick_ = tick;
    for (int i = 0; i < hal::kBeams; ++i) {
      hal::RangeReading& reading = ranges_.beam[i];
      const Beam& beam = tick.beam[i];
      if (tick.has_ranges && beam.fresh) {
        reading.mm = beam.mm;
        reading.status = beam.status;
        reading.sequence = static_cast<std::uint8_t>((reading.sequence + 1) % 16);
        taken_ms_[i] = now_ms - beam.age_ms;
      }
      reading.age_ms = static_cast<std::uint8_t>(std::min<std::uint32_t>(now_ms - taken_ms_[i], UINT8_MAX));
    }
  }

  bool read(hal::RangeReadings& out) noexcept override {
    if (tick_.has_ranges) out = ranges_;
    return tick_.has_ranges;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    if (tick_.counts) out = *tick_.counts;
    return tick_.counts.has_value();
  }
  bool read(hal::BumperReading& out) noexcept override {
    if (tick_.bumper) out = *tick_.bumper;
    return tick_.bumper.has_value();
  }
  bool read(hal::GyroReading& out) noexcept override {
    if (tick_.gyro) out = *tick_.gyro;
    return tick_.gyro.has_value();
  }
  bool command(hal::WheelSpeeds) noexcept override { return true; }

 private:
  static constexpr hal::RangeReading kNothing{0, hal::RangeStatus::stale, UINT8_MAX, 0};

  Tick tick_;
  hal::RangeReadings ranges_{{kNothing, kNothing, kNothing}};
  std::uint32_t taken_ms_[hal::kBeams] = {};
};

}  // namespace whisker::socket

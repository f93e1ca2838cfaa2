/// The HAL of the core: what the simulator said last.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>

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
    if (tick.counts) {
      if (!told_) told_ = {0, 0};
      counts_.left = turned(counts_.left, (*tick.counts)[0], (*told_)[0]);
      counts_.right = turned(counts_.right, (*tick.counts)[1], (*told_)[1]);
      told_ = tick.counts;
    }
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
    if (tick_.counts) out = counts_;
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

  /// A counter of so many bits, with or without a sign, has gone over its end.
  static bool wrapped(std::int64_t now, std::int64_t before, int bits) {
    const std::int64_t all = std::int64_t{1} << bits, low = std::min(now, before),
                       high = std::max(now, before);
    return high - low > all - kMost && ((low >= 0 && high < all) || (low >= -all / 2 && high < all / 2));
  }

  /// The encoder's next count. A jump that its range does not show is made one that it does.
  static std::uint32_t turned(std::uint32_t count, std::int64_t now, std::int64_t before) {
    std::int64_t step = now - before;
    if (std::abs(step) >= kMost && !wrapped(now, before, 24) && !wrapped(now, before, 32)) step = kMost;
    return static_cast<std::uint32_t>(count + step) % hal::kEncoderModulus;
  }

  static constexpr std::int64_t kMost = hal::kEncoderModulus / 2;

  Tick tick_;
  hal::EncoderCounts counts_{};
  std::optional<std::array<std::int64_t, 2>> told_;
  hal::RangeReadings ranges_{{kNothing, kNothing, kNothing}};
  std::uint32_t taken_ms_[hal::kBeams] = {};
};

}  // namespace whisker::socket

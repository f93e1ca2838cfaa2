/// A correct board in an open world: wheels follow with the lag, sensors have the rate and latency of the
/// parameters.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/params.hpp"
#include "hal/drive.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::test {

class LaggingBoard final : public hal::Rangefinders, public hal::Drive {
 public:
  explicit LaggingBoard(const Params& params) : params_(params) {
    for (hal::RangeReading& r : shown_.beam) {
      r = {0, hal::RangeStatus::clear, static_cast<std::uint8_t>(params.rangefinders.latency.raw()), 0};
    }
  }
  /// One control period passes.
  void pass() {
    const double lag_ms = params_.wheels.motor_lag.raw();
    const double share = lag_ms > 0 ? 1 - std::exp(-1 / lag_ms) : 1;
    for (int ms = 0; ms < params_.safety.period.raw(); ++ms) {
      for (int w = 0; w < 2; ++w) {
        speed_[w] += ((w == 0 ? command_.left : command_.right) * 1e-4 - speed_[w]) * share;
        way_[w] += speed_[w] * 1e-3;
      }
    }
    until_measurement_ms_ -= params_.safety.period.raw();
    if (until_measurement_ms_ > 0) return;
    until_measurement_ms_ += 1000 / params_.rangefinders.rate_hz;
    for (hal::RangeReading& r : shown_.beam) r.sequence = static_cast<std::uint8_t>((r.sequence + 1) % 16);
  }

  bool read(hal::RangeReadings& out) noexcept override {
    out = shown_;
    return true;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    const double skew = (params_.wheels.ratio.raw() - 1e6) / (params_.wheels.ratio.raw() + 1e6);
    out = {count(way_[0] / (1 - skew)), count(way_[1] / (1 + skew))};
    return true;
  }
  bool command(hal::WheelSpeeds speeds) noexcept override {
    command_ = speeds;
    return true;
  }

 private:
  std::uint32_t count(double way_m) const {
    const auto counts = static_cast<std::int64_t>(std::floor(way_m * params_.wheels.counts_per_metre));
    return static_cast<std::uint32_t>(counts & (hal::kEncoderModulus - 1));
  }
  const Params& params_;
  hal::RangeReadings shown_{};
  hal::WheelSpeeds command_{};
  double speed_[2] = {0, 0};
  double way_[2] = {0, 0};
  int until_measurement_ms_ = 0;
};

}  // namespace whisker::test

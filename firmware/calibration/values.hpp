/// What a calibration measures of the wheels and the gyro.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"

namespace whisker::calibration {

/// Each is a parameter, by its key in a robot file.
enum class Quantity : uint8_t {
  gyro_scale,        ///< 1e-6
  wheel_ratio,       ///< 1e-6
  counts_per_metre,  ///< encoder_counts_per_m
  track,             ///< wheel_track_m, 1e-6 m
};
constexpr int kQuantities = 4;
/// The key.
constexpr const char* name(Quantity quantity) noexcept {
  switch (quantity) {
    case Quantity::gyro_scale: return "gyro_scale";
    case Quantity::wheel_ratio: return "wheel_ratio";
    case Quantity::counts_per_metre: return "encoder_counts_per_m";
    case Quantity::track: return "wheel_track_m";
  }
  return "?";
}

struct Measured {
  int32_t value = 0;  ///< raw value of the parameter; 0: not measured
  Ratio sigma;        ///< standard deviation, relative to the value
  constexpr bool known() const noexcept { return value != 0; }
  friend constexpr bool operator==(const Measured& a, const Measured& b) noexcept {
    return a.value == b.value && a.sigma == b.sigma;
  }
};

struct Values {
  Measured of[kQuantities];
  Measured& operator[](Quantity q) noexcept { return of[static_cast<int>(q)]; }
  const Measured& operator[](Quantity q) const noexcept { return of[static_cast<int>(q)]; }
  friend constexpr bool operator==(const Values& a, const Values& b) noexcept {
    return a.of[0] == b.of[0] && a.of[1] == b.of[1] && a.of[2] == b.of[2] && a.of[3] == b.of[3];
  }
};

/// The raw value that the parameters have.
int32_t value_in(const Params& params, Quantity quantity) noexcept;
/// `value` times (1 + correction), rounded.
int32_t corrected(int32_t value, Ratio correction) noexcept;
/// The encoders' counts per metre become `value`. The track changes with them, so that the same counts still
/// turn the body by the same angle.
void rescale(Values& values, const Params& params, Measured counts_per_metre) noexcept;

/// Writes the values that are known into the parameters. Unless the result is ParamFault::none, check()
/// refuses them with it and the parameters are unchanged.
ParamFault apply(const Values& values, Params& params) noexcept;

}  // namespace whisker::calibration

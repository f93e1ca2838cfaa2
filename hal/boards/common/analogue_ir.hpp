/// Analogue infrared triangulation sensors: a voltage that falls with the distance.
#pragma once

#include <stdint.h>

#include "hal/types.hpp"

namespace whisker::hal::mcu {

/// voltage = zero + slope / distance, good between the two distances.
struct IrCurve {
  int32_t slope_mv_mm;
  int16_t zero_mv;
  int16_t nearest_mm;   ///< nearer, the voltage falls again: mount the sensor this far inside the body
  int16_t farthest_mm;  ///< farther counts as clear
  int16_t dead_mv;      ///< below: no sensor is connected
};

/// Sharp GP2Y0A21YK: the data sheet's typical values, 2.3 V at 100 mm and 0.4 V at 800 mm.
constexpr IrCurve kGp2y0a21 = {217143, 129, 100, 800, 60};
/// A new measurement comes every 38 ms +- 10 ms.
constexpr uint8_t kGp2y0a21PeriodMs = 48;

/// Fills in mm and status; age and sequence are the caller's.
void from_voltage(const IrCurve& curve, int16_t mv, hal::RangeReading& out) noexcept;

/// What a sensor of this curve shows at this distance, mV.
constexpr int16_t voltage_at(const IrCurve& curve, int16_t mm) noexcept {
  return static_cast<int16_t>(curve.zero_mv + (curve.slope_mv_mm + mm / 2) / mm);
}

}  // namespace whisker::hal::mcu

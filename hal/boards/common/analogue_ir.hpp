/// Analogue infrared triangulation sensors, whose voltage falls with the distance.
#pragma once

#include <stdint.h>

#include "hal/types.hpp"

namespace whisker::hal::mcu {

/// voltage = zero + slope / distance, valid between the two distances.
struct IrCurve {
  int32_t slope_mv_mm;
  int16_t zero_mv;
  int16_t nearest_mm;   ///< below it, the voltage falls again: mount the sensor this far inside the body
  int16_t farthest_mm;  ///< longer distances count as clear
  int16_t dead_mv;      ///< below: no sensor is connected
};

/// Sharp GP2Y0A21YK: the data sheet's typical values, 2.3 V at 100 mm and 0.4 V at 800 mm.
constexpr IrCurve kGp2y0a21 = {217143, 129, 100, 800, 60};
/// Time between two measurements: 38 ms +- 10 ms.
constexpr uint8_t kGp2y0a21PeriodMs = 48;

/// Sets mm and status; the caller sets age and sequence.
void from_voltage(const IrCurve& curve, int16_t mv, hal::RangeReading& out) noexcept;

/// Voltage of a sensor with this curve at this distance, mV.
constexpr int16_t voltage_at(const IrCurve& curve, int16_t mm) noexcept {
  return static_cast<int16_t>(curve.zero_mv + (curve.slope_mv_mm + mm / 2) / mm);
}

}  // namespace whisker::hal::mcu

#include "hal/boards/common/analogue_ir.hpp"

namespace whisker::hal::mcu {

void from_voltage(const IrCurve& curve, int16_t mv, hal::RangeReading& out) noexcept {
  out.mm = 0;
  if (mv < curve.dead_mv) {
    out.status = hal::RangeStatus::invalid;
  } else if (mv < voltage_at(curve, curve.farthest_mm)) {
    out.status = hal::RangeStatus::clear;
  } else if (mv > voltage_at(curve, curve.nearest_mm)) {
    out.status = hal::RangeStatus::too_near;
  } else {
    const int32_t above = int32_t{mv} - curve.zero_mv;
    out.mm = static_cast<uint16_t>((curve.slope_mv_mm + above / 2) / above);
    out.status = hal::RangeStatus::ok;
  }
}

}  // namespace whisker::hal::mcu

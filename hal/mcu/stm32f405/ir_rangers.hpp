#pragma once

#include "hal/mcu/common/analogue_ir.hpp"
#include "hal/mcu/stm32f405/adc.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::hal::stm32f405 {

/// Three analogue infrared sensors on the converter.
class IrRangers final : public hal::Rangefinders {
 public:
  /// All must outlive it. period_ms: of the sensors' own measurements.
  IrRangers(const mcu::IrCurve& curve, uint8_t period_ms, Adc& adc, Troubles& troubles) noexcept
      : curve_(curve), period_ms_(period_ms), adc_(adc), troubles_(troubles) {}

  void start(uint32_t now_ms) noexcept { converted_ms_ = now_ms; }
  /// Once a period, converts all three: 150 us at most.
  void poll(uint32_t now_ms) noexcept;

  bool read(hal::RangeReadings& out) noexcept override;

 private:
  const mcu::IrCurve& curve_;
  uint8_t period_ms_;
  Adc& adc_;
  Troubles& troubles_;
  uint32_t now_ms_ = 0;
  uint32_t converted_ms_ = 0;
  hal::RangeReading reading_[hal::kBeams] = {{0, hal::RangeStatus::stale, UINT8_MAX, 15},
                                             {0, hal::RangeStatus::stale, UINT8_MAX, 15},
                                             {0, hal::RangeStatus::stale, UINT8_MAX, 15}};
};

}  // namespace whisker::hal::stm32f405

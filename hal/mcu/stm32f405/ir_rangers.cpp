#include "hal/mcu/stm32f405/ir_rangers.hpp"

#include "hal/mcu/stm32f405/pins.hpp"

namespace whisker::hal::stm32f405 {

void IrRangers::poll(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  if (now_ms - converted_ms_ < period_ms_) return;
  converted_ms_ = now_ms;
  for (int i = 0; i < hal::kBeams; ++i) {
    hal::RangeReading& reading = reading_[i];
    reading.sequence = static_cast<uint8_t>((reading.sequence + 1) % 16);
    reading.status = hal::RangeStatus::invalid;
    int16_t mv = 0;
    if (adc_.convert(wiring::kInfraredChannel[i], mv, troubles_)) from_voltage(curve_, mv, reading);
  }
}

bool IrRangers::read(hal::RangeReadings& out) noexcept {
  // The voltage shows the sensor's last measurement, so it may be up to one of its periods older.
  const uint32_t age = now_ms_ - converted_ms_ + period_ms_;
  for (int i = 0; i < hal::kBeams; ++i) {
    out.beam[i] = reading_[i];
    if (reading_[i].status == hal::RangeStatus::stale) continue;
    out.beam[i].age_ms = static_cast<uint8_t>(age > UINT8_MAX ? UINT8_MAX : age);
  }
  return true;
}

}  // namespace whisker::hal::stm32f405

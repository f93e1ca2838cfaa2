#pragma once

#include "hal/boards/common/analogue_ir.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::hal::mcu {

/// Three analogue infrared sensors on an ADC. `Converter`: a class with bool convert(uint8_t channel,
/// int16_t& mv), which waits for a bounded time and counts its own failures.
template <class Converter>
class AnalogueRangers final : public Rangefinders {
 public:
  /// All must outlive it. period_ms: period of the sensors' measurements. channel: left, front, right.
  AnalogueRangers(const IrCurve& curve, uint8_t period_ms, const uint8_t (&channel)[kBeams],
                  Converter& converter) noexcept
      : curve_(curve), channel_(channel), converter_(converter), period_ms_(period_ms) {
    for (RangeReading& reading : reading_) reading = {0, RangeStatus::stale, UINT8_MAX, 15};
  }

  void start(uint32_t now_ms) noexcept { converted_ms_ = now_ms; }

  /// Converts all three once per period.
  void poll(uint32_t now_ms) noexcept {
    now_ms_ = now_ms;
    if (now_ms - converted_ms_ < period_ms_) return;
    converted_ms_ = now_ms;
    for (uint8_t i = 0; i < kBeams; ++i) {
      RangeReading& reading = reading_[i];
      reading.sequence = static_cast<uint8_t>((reading.sequence + 1) % 16);
      reading.status = RangeStatus::invalid;
      int16_t mv = 0;
      if (converter_.convert(channel_[i], mv)) from_voltage(curve_, mv, reading);
    }
  }

  bool read(RangeReadings& out) noexcept override {
    // The voltage holds the last measurement of the sensor, so it may be up to one sensor period older.
    const uint32_t age = now_ms_ - converted_ms_ + period_ms_;
    for (uint8_t i = 0; i < kBeams; ++i) {
      out.beam[i] = reading_[i];
      if (reading_[i].status == RangeStatus::stale) continue;
      out.beam[i].age_ms = static_cast<uint8_t>(age > UINT8_MAX ? UINT8_MAX : age);
    }
    return true;
  }

 private:
  const IrCurve& curve_;
  const uint8_t (&channel_)[kBeams];
  Converter& converter_;
  uint8_t period_ms_;
  uint32_t now_ms_ = 0;
  uint32_t converted_ms_ = 0;
  RangeReading reading_[kBeams];
};

}  // namespace whisker::hal::mcu

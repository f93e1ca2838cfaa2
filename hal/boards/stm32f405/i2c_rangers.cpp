#include "hal/boards/stm32f405/i2c_rangers.hpp"

#include "hal/boards/stm32f405/pins.hpp"

namespace whisker::hal::stm32f405 {
namespace {

constexpr uint8_t address_of(uint8_t beam) noexcept {
  return static_cast<uint8_t>(I2cRangers::kFirstAddress + beam);
}

}  // namespace

void I2cRangers::start(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  for (uint8_t i = 0; i < hal::kBeams; ++i) hold(i, now_ms);
}

void I2cRangers::hold(uint8_t beam, uint32_t now_ms) noexcept {
  write(wiring::kRangerAwake[beam], false);
  sensor_[beam].phase = Phase::held;
  sensor_[beam].since_ms = now_ms;
}

bool I2cRangers::somebody_is_waking() const noexcept {
  for (const Sensor& s : sensor_) {
    if (s.phase == Phase::waking) return true;
  }
  return false;
}

void I2cRangers::wake(uint8_t beam, uint32_t now_ms) noexcept {
  Sensor& sensor = sensor_[beam];
  if (!kind_.start(bus_, address_of(beam))) {
    troubles_.count(Trouble::ranger_not_started);
    hold(beam, now_ms);
    return;
  }
  sensor.phase = Phase::measuring;
  sensor.since_ms = now_ms;
  sensor.measured_ms = now_ms;
}

void I2cRangers::measure(uint8_t beam, uint32_t now_ms) noexcept {
  Sensor& sensor = sensor_[beam];
  hal::RangeReading fresh = sensor.reading;
  const Taken taken = kind_.take(bus_, address_of(beam), fresh);
  if (taken == Taken::measured) {
    fresh.sequence = static_cast<uint8_t>((fresh.sequence + 1) % 16);
    sensor.reading = fresh;
    sensor.measured_ms = now_ms;
  } else if (now_ms - sensor.measured_ms > kind_.silent_ms) {
    troubles_.count(Trouble::ranger_silent);
    hold(beam, now_ms);
  }
}

void I2cRangers::poll(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  const uint8_t beam = next_;
  next_ = static_cast<uint8_t>((next_ + 1) % hal::kBeams);
  Sensor& sensor = sensor_[beam];
  switch (sensor.phase) {
    case Phase::held:
      if (now_ms - sensor.since_ms < kHeldMs || somebody_is_waking()) return;
      write(wiring::kRangerAwake[beam], true);
      sensor.phase = Phase::waking;
      sensor.since_ms = now_ms;
      return;
    case Phase::waking:
      if (now_ms - sensor.since_ms >= kind_.wake_ms) wake(beam, now_ms);
      return;
    case Phase::measuring: measure(beam, now_ms); return;
  }
}

bool I2cRangers::read(hal::RangeReadings& out) noexcept {
  for (int i = 0; i < hal::kBeams; ++i) {
    const Sensor& sensor = sensor_[i];
    const uint32_t age = now_ms_ - sensor.measured_ms + kind_.ranging_ms;
    hal::RangeReading& reading = out.beam[i];
    reading = sensor.reading;
    if (reading.status == hal::RangeStatus::stale) continue;
    reading.age_ms = static_cast<uint8_t>(age > UINT8_MAX ? UINT8_MAX : age);
  }
  return true;
}

}  // namespace whisker::hal::stm32f405

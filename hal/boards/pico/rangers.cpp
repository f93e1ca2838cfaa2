#include "hal/boards/pico/rangers.hpp"

#include "hal/boards/pico/pins.hpp"

namespace whisker::hal::pico {

namespace vl53l0x = mcu::vl53l0x;

void Rangers::start(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  for (uint8_t i = 0; i < kBeams; ++i) hold(i);
}

void Rangers::hold(uint8_t beam) noexcept {
  write(wiring::kAwake[beam], false);
  sensor_[beam].phase = Phase::held;
  sensor_[beam].since_ms = now_ms_;
}

/// No sensor is at the address that all have after their reset.
bool Rangers::is_alone_awake() const noexcept {
  for (const Sensor& s : sensor_) {
    if (s.phase == Phase::waking || s.phase == Phase::identify || s.phase == Phase::move) return false;
  }
  return true;
}

bool Rangers::next(uint8_t beam, I2c::Transfer& transfer) noexcept {
  Sensor& sensor = sensor_[beam];
  const uint32_t passed = now_ms_ - sensor.since_ms;
  const uint8_t address = address_of(beam);
  switch (sensor.phase) {
    case Phase::held:
      if (passed < kHeldMs || !is_alone_awake()) return false;
      write(wiring::kAwake[beam], true);
      sensor.phase = Phase::waking;
      sensor.since_ms = now_ms_;
      return false;
    case Phase::waking:
      if (passed < kWakeMs) return false;
      sensor.phase = Phase::identify;
      [[fallthrough]];
    case Phase::identify: transfer = {vl53l0x::kDefaultAddress, {vl53l0x::kModel}, 1, 1}; break;
    case Phase::move: transfer = {vl53l0x::kDefaultAddress, {vl53l0x::kAddress, address}, 2, 0}; break;
    case Phase::clear:
    case Phase::acknowledge: transfer = {address, {vl53l0x::kInterruptClear, 1}, 2, 0}; break;
    case Phase::begin: transfer = {address, {vl53l0x::kStart, vl53l0x::kBackToBack}, 2, 0}; break;
    case Phase::ask: transfer = {address, {vl53l0x::kInterruptStatus}, 1, 1}; break;
    case Phase::fetch: transfer = {address, {vl53l0x::kRangeStatus}, 1, vl53l0x::kRangeBytes}; break;
  }
  return true;
}

bool Rangers::succeed(uint8_t beam, const I2c& bus) noexcept {
  Sensor& sensor = sensor_[beam];
  switch (sensor.phase) {
    case Phase::held:
    case Phase::waking: return false;
    case Phase::identify:
      if (bus.in()[0] != vl53l0x::kModelValue) {
        fail(beam);
        return false;
      }
      sensor.phase = Phase::move;
      return true;
    case Phase::move: sensor.phase = Phase::clear; return true;
    case Phase::clear: sensor.phase = Phase::begin; return true;
    case Phase::begin:
      sensor.phase = Phase::ask;
      sensor.measured_ms = now_ms_;
      return false;
    case Phase::ask:
      if ((bus.in()[0] & 0x07) != 0) {
        sensor.phase = Phase::fetch;
        return true;
      }
      if (now_ms_ - sensor.measured_ms > kSilentMs) fail(beam);
      return false;
    case Phase::fetch: {
      uint8_t bytes[vl53l0x::kRangeBytes];
      for (uint8_t i = 0; i < vl53l0x::kRangeBytes; ++i) bytes[i] = bus.in()[i];
      vl53l0x::decode(bytes, sensor.reading);
      sensor.reading.sequence = static_cast<uint8_t>((sensor.reading.sequence + 1) % 16);
      sensor.measured_ms = now_ms_;
      published_[beam].publish({sensor.reading, sensor.measured_ms});
      sensor.phase = Phase::acknowledge;
      return true;
    }
    case Phase::acknowledge: sensor.phase = Phase::ask; return false;
  }
  return false;
}

void Rangers::fail(uint8_t beam) noexcept {
  Sensor& sensor = sensor_[beam];
  const bool measures = sensor.phase >= Phase::ask;
  if (measures && now_ms_ - sensor.measured_ms <= kSilentMs) return;
  (measures ? silent_ : not_started_).happened();
  hold(beam);
}

bool Rangers::read(RangeReadings& out) noexcept {
  const uint32_t now_ms = now_ms_;
  for (uint8_t i = 0; i < kBeams; ++i) {
    Published last;
    if (!published_[i].read(last)) last = {};
    out.beam[i] = last.reading;
    if (last.reading.status == RangeStatus::stale) continue;
    const uint32_t age = now_ms - last.measured_ms + vl53l0x::kRangingMs;
    out.beam[i].age_ms = static_cast<uint8_t>(age > UINT8_MAX ? UINT8_MAX : age);
  }
  return true;
}

void Rangers::collect(Troubles& troubles) noexcept {
  troubles.count(Trouble::ranger_not_started, not_started_.collect());
  troubles.count(Trouble::ranger_silent, silent_.collect());
}

}  // namespace whisker::hal::pico

#include "hal/boards/atmega1284p/sonar.hpp"

#include "hal/boards/atmega1284p/pins.hpp"

namespace whisker::hal::atmega1284p {
namespace {

constexpr uint8_t kFallEdge = bits::kICNC1 | bits::kCS11 | bits::kCS10;  // 16 MHz / 64: 4 us
constexpr uint8_t kRiseEdge = kFallEdge | bits::kICES1;
constexpr uint8_t kShotCycles = 60;  // three cycles each at least: 11 us

/// 343 m/s there and back: 0.686 mm in 4 us.
constexpr uint16_t millimetres_of(uint16_t counts) noexcept {
  return static_cast<uint16_t>((uint32_t{counts} * 686 + 500) / 1000);
}
static_assert(millimetres_of(2915) == 2000);

void pause(uint8_t turns) noexcept {
  for (; turns != 0; --turns) asm volatile("nop");
}

}  // namespace

SonarRangers::SonarRangers(Troubles& troubles) noexcept : troubles_(troubles) {
  for (Sensor& sensor : sensor_) sensor = {{0, RangeStatus::stale, UINT8_MAX, 15}, 0};
}

void SonarRangers::start(uint32_t now_ms) noexcept {
  for (const uint8_t trigger : wiring::kTrigger) set(reg::kDDRB, trigger);
  store(reg::kTCCR1A, 0);
  store(reg::kTCCR1B, kRiseEdge);
  store(reg::kTIMSK1, bits::kICIE1);
  slot_ms_ = now_ms;
}

void SonarRangers::on_interrupt() noexcept {
  const uint16_t at = load(reg::kICR1L, reg::kICR1H);
  const bool rose = is_set(reg::kTCCR1B, bits::kICES1);
  store(reg::kTCCR1B, rose ? kFallEdge : kRiseEdge);
  // Changing the edge may raise the flag.
  store(reg::kTIFR1, bits::kICF1);
  if (rose) {
    rise_ = at;
    begun_.happened();
  } else {
    lengths_.push(static_cast<uint16_t>(at - rise_));
  }
}

void SonarRangers::finish(RangeStatus status, uint16_t mm) noexcept {
  Sensor& sensor = sensor_[beam_];
  sensor.reading.status = status;
  sensor.reading.mm = mm;
  sensor.reading.sequence = static_cast<uint8_t>((sensor.reading.sequence + 1) % 16);
  sensor.fired_ms = slot_ms_;
  phase_ = Phase::quiet;
  beam_ = static_cast<uint8_t>(beam_ + 1 < kBeams ? beam_ + 1 : 0);
}

void SonarRangers::fail(Trouble trouble) noexcept {
  troubles_.count(trouble);
  finish(RangeStatus::invalid, 0);
}

void SonarRangers::fire(uint32_t now_ms) noexcept {
  slot_ms_ = now_ms;
  if (is_set(reg::kPINB, wiring::kEcho)) {
    fail(Trouble::echo_line_high);
    return;
  }
  uint16_t late = 0;
  while (lengths_.pop(late)) {
  }
  begun_.collect();
  set(reg::kPORTB, wiring::kTrigger[beam_]);
  pause(kShotCycles);
  clear(reg::kPORTB, wiring::kTrigger[beam_]);
  phase_ = Phase::shot;
}

void SonarRangers::wait(uint32_t now_ms) noexcept {
  if (phase_ == Phase::shot && begun_.collect() != 0) phase_ = Phase::echo;
  uint16_t length = 0;
  const uint32_t since = now_ms - slot_ms_;
  if (phase_ == Phase::echo && lengths_.pop(length)) {
    const uint16_t mm = millimetres_of(length);
    const RangeStatus status = mm > kFarthestMm  ? RangeStatus::clear
                               : mm < kNearestMm ? RangeStatus::too_near
                                                 : RangeStatus::ok;
    finish(status, mm);
  } else if (phase_ == Phase::shot && since > kAnswerMs) {
    fail(Trouble::echo_missing);
  } else if (since > kEndlessMs) {
    fail(Trouble::echo_endless);
  }
}

void SonarRangers::poll(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  if (phase_ != Phase::quiet) {
    wait(now_ms);
  } else if (now_ms - slot_ms_ >= kSlotMs) {
    fire(now_ms);
  }
}

bool SonarRangers::read(RangeReadings& out) noexcept {
  for (uint8_t i = 0; i < kBeams; ++i) {
    const Sensor& sensor = sensor_[i];
    const uint32_t age = now_ms_ - sensor.fired_ms;
    out.beam[i] = sensor.reading;
    if (sensor.reading.status == RangeStatus::stale) continue;
    out.beam[i].age_ms = static_cast<uint8_t>(age > UINT8_MAX ? UINT8_MAX : age);
  }
  return true;
}

}  // namespace whisker::hal::atmega1284p

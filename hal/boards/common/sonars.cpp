#include "hal/boards/common/sonars.hpp"

namespace whisker::hal::mcu {
namespace {

/// There and back at 340 m/s.
constexpr uint32_t millimetres(uint32_t us) noexcept { return us * 17 / 100; }

}  // namespace

void Sonars::answer(Ping& ping, RangeStatus status, uint32_t mm) noexcept {
  ping.open = false;
  ping.measured_us = ping.at_us;
  ping.reading.status = status;
  ping.reading.mm = static_cast<uint16_t>(mm);
  ping.reading.sequence = static_cast<uint8_t>((ping.reading.sequence + 1) % 16);
}

void Sonars::hear(int beam, bool paused) noexcept {
  Ping& ping = pings_[beam];
  Line line;
  if (!ping.open || !published_[beam].read(line)) return;
  const bool rose = line.rose_us - ping.at_us <= kRisesWithinUs;
  if (!rose && now_us_ - ping.at_us <= kRisesWithinUs) return;
  if (!rose || paused) return answer(ping, RangeStatus::invalid);
  if (line.high) return;
  const uint32_t width = line.fell_us - line.rose_us;
  answer(ping, width <= kTurnUs ? RangeStatus::ok : RangeStatus::clear, millimetres(width));
}

int Sonars::take_turn(uint32_t now_us) noexcept {
  const bool paused = now_us - now_us_ > kPauseUs;
  now_us_ = now_us;
  for (int i = 0; i < kBeams; ++i) hear(i, paused);
  if (now_us - turned_us_ < kTurnUs) return kNone;
  turned_us_ = now_us;
  turn_ = (turn_ + 1) % kBeams;
  pings_[turn_].at_us = now_us;
  pings_[turn_].open = true;
  return turn_;
}

bool Sonars::read(RangeReadings& out) noexcept {
  for (int i = 0; i < kBeams; ++i) {
    out.beam[i] = pings_[i].reading;
    const uint32_t age_ms = (now_us_ - pings_[i].measured_us + 999) / 1000;
    if (out.beam[i].status != RangeStatus::stale)
      out.beam[i].age_ms = static_cast<uint8_t>(age_ms > UINT8_MAX ? UINT8_MAX : age_ms);
  }
  return true;
}

}  // namespace whisker::hal::mcu

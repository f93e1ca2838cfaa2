#include "tests/robot/properties/storm_board.hpp"

#include <algorithm>

namespace whisker::test {
namespace {

std::int64_t um_in(std::int16_t speed, Duration t) { return std::int64_t{speed} * 100 * t.raw() / 1000; }

}  // namespace

StormBoard::StormBoard(Bits bits, const Params& params, int fury)
    : bits_(bits), params_(params), fury_(fury) {}

void StormBoard::begin_spell() {
  spell_ = bits_.whole(1, 150);
  const bool fair = fury_ == 0 || bits_.one_in(fury_ + 1);
  ranges_ = fair ? Ranges::steady : static_cast<Ranges>(bits_.whole(0, 4));
  wheels_ = fair ? Wheels::obey : static_cast<Wheels>(bits_.whole(0, 5));
  const int top = params_.rangefinders.max_range.raw() / 1000;
  for (int& d : distance_mm_) d = bits_.one_in(3) ? top + 1 : bits_.whole(0, std::min(top, 1500));
}

void StormBoard::measure() {
  const int top = params_.rangefinders.max_range.raw() / 1000;
  for (int i = 0; i < hal::kBeams; ++i) {
    hal::RangeReading& r = shown_.beam[i];
    const int noise = ranges_ == Ranges::noisy ? bits_.whole(-200, 200) : bits_.whole(-2, 2);
    const int mm = std::max(0, distance_mm_[i] + noise);
    r.status = distance_mm_[i] > top || mm > top ? hal::RangeStatus::clear : hal::RangeStatus::ok;
    r.mm = static_cast<std::uint16_t>(std::min(mm, 65535));
    r.age_ms = static_cast<std::uint8_t>(params_.rangefinders.latency.raw());
    r.sequence = static_cast<std::uint8_t>((r.sequence + 1) % 16);
  }
}

void StormBoard::pass() {
  if (--spell_ < 0) begin_spell();
  const hal::WheelSpeeds rolling = wheels_ == Wheels::run_on ? hal::WheelSpeeds{777, -777} : command_;
  if (wheels_ != Wheels::stand) {
    way_um_[0] += um_in(rolling.left, params_.safety.period);
    way_um_[1] += um_in(rolling.right, params_.safety.period);
  }
  until_measurement_ -= params_.safety.period.raw();
  if (until_measurement_ > 0 || ranges_ == Ranges::frozen) return;
  until_measurement_ += 1000 / params_.rangefinders.rate_hz;
  measure();
}

bool StormBoard::read(hal::RangeReadings& out) noexcept {
  if (ranges_ == Ranges::refusing) return false;
  out = shown_;
  if (ranges_ != Ranges::absurd) return true;
  for (hal::RangeReading& r : out.beam) {
    r = {static_cast<std::uint16_t>(bits_.next()), static_cast<hal::RangeStatus>(bits_.whole(0, 6)),
         static_cast<std::uint8_t>(bits_.next()), static_cast<std::uint8_t>(bits_.next())};
  }
  return true;
}

bool StormBoard::read(hal::EncoderCounts& out) noexcept {
  if (wheels_ == Wheels::silent && !bits_.one_in(8)) return false;
  const auto counts = [this](std::int64_t um) {
    return static_cast<std::uint32_t>(um * params_.wheels.counts_per_metre / 1000000) % hal::kEncoderModulus;
  };
  out = {counts(way_um_[0]), counts(way_um_[1])};
  if (wheels_ == Wheels::absurd && bits_.one_in(4)) {
    out = {static_cast<std::uint32_t>(bits_.next()), static_cast<std::uint32_t>(bits_.next())};
  }
  return true;
}

bool StormBoard::command(hal::WheelSpeeds speeds) noexcept {
  refused_ = wheels_ == Wheels::refusing && !bits_.one_in(8);
  command_ = refused_ ? hal::WheelSpeeds{} : speeds;
  return !refused_;
}

}  // namespace whisker::test

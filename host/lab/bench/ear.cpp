#include "host/lab/bench/ear.hpp"

#include <fmt/format.h>

#include "firmware/can/value_names.hpp"
#include "host/harness/hil/overheard.hpp"

namespace whisker::bench {
namespace {

constexpr double kNear_mm = 300, kNearer_mm = 10;
constexpr double kNothing_mm = 1e6;

/// Of numbers modulo 2^24.
std::int32_t change(std::uint32_t from, std::uint32_t to) {
  return static_cast<std::int32_t>((to - from) << 8) >> 8;
}

int count_of(const int (&of)[5], hal::RangeStatus status) { return of[static_cast<int>(status)]; }

}  // namespace

void Ear::on_frame(const hal::CanFrame& frame) {
  if (!state_.on_frame(frame, robot_)) return;
  const can::MessageKind kind = hil::sender_of(frame)->kind;
  if (kind == can::MessageKind::gyro) {
    hil::with<can::GyroState>(frame, [&](const auto& m) { on_gyro(m); });
  }
  if (kind == can::MessageKind::sync) on_tick();
}

void Ear::on_tick() {
  const std::uint32_t tick = state_.sync->tick;
  if (tick_ == tick) return;
  if (tick_) missed_ += tick - *tick_ - 1;
  tick_ = tick;
  ++ticks_;
  for (int i = 0; i < hal::kBeams; ++i) on_range(i);
  on_wheels();
}

void Ear::on_range(int beam) {
  const auto& reading = state_.beams[beam];
  if (!reading) return;
  Beam& b = beams_[beam];
  bool nearest = distance_mm(beam) < kNear_mm;
  for (int other = 0; other < hal::kBeams; ++other)
    nearest = nearest && (other == beam || distance_mm(beam) + kNearer_mm <= distance_mm(other));
  if (nearest != (b.nearest > 0)) b.nearest = 0;
  b.nearest += nearest ? 1 : -1;

  const bool first = !b.sequence;
  if (b.sequence == reading->sequence && reading->status != hal::RangeStatus::stale) return;
  b.sequence = reading->sequence;
  if (first) return;
  ++b.measurements;
  ++b.of[static_cast<int>(reading->status)];
  if (reading->status != hal::RangeStatus::ok) return;
  if (count_of(b.of, hal::RangeStatus::ok) == 1) b.least_mm = reading->mm;
  if (reading->mm < b.least_mm) b.least_mm = reading->mm;
  if (reading->mm > b.most_mm) b.most_mm = reading->mm;
}

void Ear::on_wheels() {
  if (!state_.wheels || state_.wheels->valid == 0) return;
  const hal::EncoderCounts now = state_.wheels->counts;
  const hal::EncoderCounts before = counts_.value_or(now);
  const std::int32_t left = change(before.left, now.left), right = change(before.right, now.right);
  turned_[0] += left;
  turned_[1] += right;
  stood_ = left == 0 && right == 0 ? stood_ + 1 : 0;
  counts_ = now;
}

void Ear::on_gyro(const can::GyroState& now) {
  if (now.valid == 0) return;
  if (gyro_) {
    sum_ += change(gyro_->reading.sum, now.reading.sum);
    samples_ += static_cast<std::uint16_t>(now.reading.samples - gyro_->reading.samples);
  }
  gyro_ = now;
}

double Ear::time_s() const { return state_.sync ? ticks_ * state_.sync->period_ms * 1e-3 : 0; }

double Ear::distance_mm(int beam) const {
  const auto& r = state_.beams[beam];
  if (r && r->status == hal::RangeStatus::ok) return r->mm;
  return r && r->status == hal::RangeStatus::too_near ? 0 : kNothing_mm;
}

int Ear::without_proof(int beam) const {
  const Beam& b = beams_[beam];
  return count_of(b.of, hal::RangeStatus::invalid) + count_of(b.of, hal::RangeStatus::stale);
}

std::string Ear::measured(int beam) const {
  const Beam& b = beams_[beam];
  std::string text = fmt::format("{} measurements", b.measurements);
  for (int i = 0; i < 5; ++i) {
    if (b.of[i] > 0) text += fmt::format(", {} {}", can::word_in<can::kRangeWords>(i), b.of[i]);
  }
  if (count_of(b.of, hal::RangeStatus::ok) > 0)
    text += fmt::format(", {:.3f} to {:.3f} m", b.least_mm / 1e3, b.most_mm / 1e3);
  return text;
}

std::string Ear::ranges() const {
  std::string text;
  for (int i = 0; i < hal::kBeams; ++i) {
    const double mm = distance_mm(i);
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", kSides[i],
                        mm < kNothing_mm ? fmt::format("{:.2f} m", mm / 1e3) : "nothing");
  }
  return text;
}

std::optional<double> Ear::gyro_mean() const {
  if (samples_ == 0) return std::nullopt;
  return static_cast<double>(sum_) / static_cast<double>(samples_);
}

}  // namespace whisker::bench

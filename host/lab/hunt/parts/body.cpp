#include "host/lab/hunt/parts/body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/harness/run/spec.hpp"

namespace whisker::hunt {

Body::Body(const Params& p, Clutter around, sim::Pose at) : world(std::move(around)), p_(p), pose_(at) {
  measure();
}

void Body::pass(int ms) {
  for (int i = 0; i < ms; ++i) {
    roll();
    ++now_ms_;
    if (now_ms_ >= next_ms_) measure();
  }
}

void Body::roll() {
  const double lag_s = p_.wheels.motor_lag.raw() * 1e-3;
  const double asked[] = {commanded.left * 1e-4, commanded.right * 1e-4};
  double rolled[2];
  for (std::size_t i = 0; i < 2; ++i) {
    v_[i] += (asked[i] * share[i] - v_[i]) * (lag_s > 0 ? 1 - std::exp(-1e-3 / lag_s) : 1);
    rolled[i] = v_[i] * 1e-3;
    way_[i] += rolled[i] * p_.wheels.counts_per_metre * counted[i];
  }
  const double turn = (rolled[1] - rolled[0]) / metres(p_.body.track), way = (rolled[0] + rolled[1]) / 2;
  const double middle = pose_.heading + turn / 2;
  pose_.at = pose_.at + sim::Vec2{std::cos(middle), std::sin(middle)} * way;
  pose_.heading += turn;
}

void Body::measure() {
  next_ms_ = now_ms_ + 1000 / p_.rangefinders.rate_hz;
  Measured m{now_ms_, {}};
  for (int i = 0; i < 3; ++i) m.distance_m[static_cast<std::size_t>(i)] = range_m(p_, world, pose_, i);
  measured_.push_back(m);
}

bool Body::read(hal::RangeReadings& out) noexcept {
  if (refuses_ranges) return false;
  while (measured_.size() > 1 && measured_[1].at_ms + p_.rangefinders.latency.raw() <= now_ms_) {
    measured_.pop_front();
    sequence_ = static_cast<std::uint8_t>((sequence_ + 1) % 16);
  }
  const Measured& m = measured_.front();
  for (int i = 0; i < 3; ++i) {
    const double d = m.distance_m[static_cast<std::size_t>(i)];
    hal::RangeReading& r = out.beam[i];
    r.age_ms = static_cast<std::uint8_t>(std::min(254, now_ms_ - m.at_ms));
    r.sequence = sequence_;
    r.mm = static_cast<std::uint16_t>(std::lround(std::min(d, 60.0) * 1000));
    const bool far = d >= metres(p_.rangefinders.max_range), near = d < metres(p_.rangefinders.min_range);
    r.status = far ? hal::RangeStatus::clear : near ? hal::RangeStatus::too_near : hal::RangeStatus::ok;
    if (i == lost_beam) r.status = hal::RangeStatus::invalid;
  }
  return true;
}

bool Body::read(hal::EncoderCounts& out) noexcept {
  if (refuses_counts) return false;
  const auto count = [&](std::size_t i) {
    const auto whole = static_cast<std::int64_t>(std::floor(way_[i]));
    return static_cast<std::uint32_t>(whole + jump[i]) & (hal::kEncoderModulus - 1);
  };
  out = {count(0), count(1)};
  return true;
}

bool Body::read(hal::BumperReading& out) noexcept {
  if (refuses_bumper) return false;
  out.pressed = pressed;
  return true;
}

bool Body::command(hal::WheelSpeeds speeds) noexcept {
  commanded = refuses_commands ? hal::WheelSpeeds{} : speeds;
  return !refuses_commands;
}

bool Body::stands() const { return std::fabs(v_[0]) < 1e-4 && std::fabs(v_[1]) < 1e-4; }

double Body::gap_m() const { return world.distance(pose_.at) - metres(p_.body.radius); }

}  // namespace whisker::hunt

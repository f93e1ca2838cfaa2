#include "host/lab/calibration/spin.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "host/harness/scenario/bearing.hpp"

namespace whisker::calibration {
namespace {

// More than half around to each side: headings that face the wall are near zero, where a scale error of the
// wheels counts least, and no edge lies at the ends.
constexpr double kHalfTurn = 190 * kRadPerDeg;
constexpr double kAside = -90 * kRadPerDeg;
constexpr double kRest_s = 0.5;  // until the wheels stand and the last readings have arrived
constexpr double kSlowest = 8 * kRadPerDeg, kFastest = 25 * kRadPerDeg;
constexpr double kStep = 0.5 * kRadPerDeg;  // between two measurements
constexpr double kAhead_m_s = 0.05;
constexpr double kPatience_s = 2;

}  // namespace

Spin::Spin(const Params& params, double along_m)
    : rate_rad_s_(std::clamp(params.rangefinders.rate_hz * kStep, kSlowest, kFastest)),
      rim_m_s_(rate_rad_s_ * params.body.track.raw() * 1e-6 / 2) {
  const double fastest = params.wheels.max_speed.raw() * 1e-6;
  if (rim_m_s_ > fastest) {
    rate_rad_s_ *= fastest / rim_m_s_;
    rim_m_s_ = fastest;
  }
  const Move rest{Move::Kind::rest, kRest_s, kRest_s};
  moves_ = {rest};
  turn_to(kHalfTurn);
  turn_to(-kHalfTurn);
  turn_to(0);
  if (along_m <= 0) return;
  turn_to(kAside);
  moves_.push_back({Move::Kind::ahead, along_m, along_m / kAhead_m_s});
  moves_.push_back(rest);
  turn_to(kHalfTurn);
  turn_to(-kHalfTurn);
  turn_to(0);
}

void Spin::turn_to(double rad) {
  const double angle = rad - turned_to_;
  moves_.push_back({angle > 0 ? Move::Kind::left : Move::Kind::right, rad, std::fabs(angle) / rate_rad_s_});
  moves_.push_back({Move::Kind::rest, kRest_s, kRest_s});
  turned_to_ = rad;
}

double Spin::duration_s() const {
  double sum = 0;
  for (const Move& move : moves_) sum += move.usual_s;
  return sum;
}

bool Spin::complete(const Move& move, double turned_rad, double from_start_m, double since_s) {
  switch (move.kind) {
    case Move::Kind::rest: return since_s >= move.until;
    case Move::Kind::left: return turned_rad >= move.until;
    case Move::Kind::right: return turned_rad <= move.until;
    case Move::Kind::ahead: return from_start_m >= move.until;
  }
  return true;
}

hal::WheelSpeeds Spin::step(double turned_rad, double from_start_m, double t_s) {
  if (done() || failed_) return {0, 0};
  if (complete(moves_[at_], turned_rad, from_start_m, t_s - entered_s_)) {
    ++at_;
    entered_s_ = t_s;
    if (done()) return {0, 0};
  }
  const Move& move = moves_[at_];
  failed_ = t_s - entered_s_ > 2 * move.usual_s + kPatience_s;
  if (failed_) return {0, 0};
  const auto rim = static_cast<std::int16_t>(std::lround(rim_m_s_ * 1e4));
  const auto ahead = static_cast<std::int16_t>(std::lround(kAhead_m_s * 1e4));
  switch (move.kind) {
    case Move::Kind::left: return {static_cast<std::int16_t>(-rim), rim};
    case Move::Kind::right: return {rim, static_cast<std::int16_t>(-rim)};
    case Move::Kind::ahead: return {ahead, ahead};
    case Move::Kind::rest: break;
  }
  return {0, 0};
}

}  // namespace whisker::calibration

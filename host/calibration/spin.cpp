#include "host/calibration/spin.hpp"

#include <algorithm>
#include <cmath>

#include "host/scenario/bearing.hpp"

namespace whisker::calibration {
namespace {

constexpr double kTurn = 380 * kRadPerDeg;  // more than once around, so that no edge lies at the ends
constexpr double kRest_s = 0.5;             // until the wheels stand and the last readings have arrived
constexpr double kSlowest = 8 * kRadPerDeg, kFastest = 25 * kRadPerDeg;
constexpr double kStep = 0.5 * kRadPerDeg;  // between two measurements

}  // namespace

Spin::Spin(const Params& params)
    : rate_rad_s_(std::clamp(params.rangefinders.rate_hz * kStep, kSlowest, kFastest)),
      rim_m_s_(rate_rad_s_ * params.body.track.raw() * 1e-6 / 2) {
  const double fastest = params.wheels.max_speed.raw() * 1e-6;
  if (rim_m_s_ <= fastest) return;
  rate_rad_s_ *= fastest / rim_m_s_;
  rim_m_s_ = fastest;
}

double Spin::duration_s() const { return 2 * kTurn / rate_rad_s_ + 3 * kRest_s; }

void Spin::enter(Phase phase, double t_s) {
  phase_ = phase;
  entered_s_ = t_s;
}

hal::WheelSpeeds Spin::turning(int sign) const {
  const auto tenths = static_cast<std::int16_t>(sign * std::lround(rim_m_s_ * 1e4));
  return {static_cast<std::int16_t>(-tenths), tenths};
}

hal::WheelSpeeds Spin::step(double turned_rad, double t_s) {
  const double since = t_s - entered_s_;
  const bool rested = since >= kRest_s, late = since > 2 * kTurn / rate_rad_s_;
  switch (phase_) {
    case Phase::settle:
      if (rested) enter(Phase::forth, t_s);
      break;
    case Phase::forth:
      if (turned_rad >= kTurn)
        enter(Phase::pause, t_s);
      else if (late)
        enter(Phase::failed, t_s);
      break;
    case Phase::pause:
      if (rested) enter(Phase::back, t_s);
      break;
    case Phase::back:
      if (turned_rad <= 0)
        enter(Phase::last, t_s);
      else if (late)
        enter(Phase::failed, t_s);
      break;
    case Phase::last:
      if (rested) enter(Phase::done, t_s);
      break;
    case Phase::done:
    case Phase::failed: break;
  }
  if (phase_ == Phase::forth) return turning(1);
  if (phase_ == Phase::back) return turning(-1);
  return {0, 0};
}

}  // namespace whisker::calibration

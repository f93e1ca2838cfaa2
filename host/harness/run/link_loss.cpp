#include "host/harness/run/link_loss.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/math/fixed.hpp"

namespace whisker {
namespace {

constexpr double kStanding_mps = 1e-3;

bool stands(hal::WheelSpeeds command, const sim::Plant& plant) {
  return command.left == 0 && command.right == 0 && std::fabs(plant.v_left()) < kStanding_mps &&
         std::fabs(plant.v_right()) < kStanding_mps;
}

}  // namespace

std::int16_t braking_step(const Params& p) {
  const std::int32_t um_per_s = (p.wheels.max_acceleration * p.safety.period).raw();
  return saturate16(um_per_s / 100 > 0 ? um_per_s / 100 : 1);
}

std::uint64_t LinkLoss::ticks_of(double for_s) const {
  return static_cast<std::uint64_t>(std::ceil(for_s * 1000 / period_ms_ - 1e-9));
}

bool LinkLoss::stops(double for_s) const { return ticks_of(for_s) * period_ms_ > can::kCommandLate_ms; }

void LinkLoss::lose(double for_s) { ticks_ = ticks_of(for_s); }

LinkLoss::Step LinkLoss::step(hal::WheelSpeeds command, const sim::Plant& plant) {
  if (!lost()) return Step::up;
  silent_ms_ += period_ms_;
  const bool over = ticks_ == 0;
  if (!over) --ticks_;
  braking_ = braking_ || restarts_ || (!over && silent_ms_ > can::kCommandLate_ms);
  if (braking_ && (!over || !stands(command, plant))) return Step::brake;
  if (!over) return Step::hold;
  gap_ms_ = silent_ms_;
  const Step end = restarts_ ? Step::restart : braking_ ? Step::resume : Step::back;
  silent_ms_ = 0;
  braking_ = restarts_ = false;
  return end;
}

}  // namespace whisker

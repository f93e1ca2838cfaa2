#include "firmware/planning/boundary/evasion.hpp"

#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

// Behind the body's centre; for the reference body.
constexpr Length kPassed = 50_mm;
// From the object's nearest point to the body's rim. What moves has a size of its own, so a small body leaves
// as far as a large one: clear is more than a radius of 0.3 m, because the line of the motion is not known
// well.
constexpr Length kClear = 470_mm;
constexpr Length kThreatened = 550_mm;
constexpr Length kNear = 710_mm;
constexpr Angle kFacing = 3_deg;
// From the object's motion, in order of preference.
constexpr int8_t kOffDegrees[] = {90, 120, 60, 30};
// Behind the body, only the ground that it has just left is known to be free, so it prefers to turn.
constexpr Angle kBackwards = 120_deg;

}  // namespace

bool Evasion::threatened(const View& view, const Params& params) noexcept {
  if (view.mover.seen) {
    at_ = view.mover.at;
    const int32_t off = (bearing(view.pose.at - at_) - view.mover.direction).wrapped();
    direction_ = view.mover.direction + Angle::from_raw(static_cast<uint32_t>(off / 2));
    unseen_for_ = Duration{};
  } else if (unseen_for_ < kForgotten) {
    unseen_for_ += view.elapsed;
  }
  const Vec from = view.pose.at - at_;
  aside_ = -across(from, direction_);
  return unseen_for_ < kForgotten && along(from, direction_) > -for_body(params, kPassed) &&
         abs(aside_) < params.body.radius + kThreatened && !farther(from, params.body.radius + kNear);
}

Manoeuvre Evasion::step(const View& view, const Params& params) const noexcept {
  if ((left_ ? aside_ : -aside_) > params.body.radius + kClear) return cruise({}, params);
  const Reach& reach = view.local_grid->reach();
  Angle heading;
  int best = static_cast<int>(Way::occupied) + 1;
  for (const int8_t degrees : kOffDegrees) {
    const Angle off = 1_deg * degrees;
    const Angle candidate = direction_ + (left_ ? off : -off);
    const int found = static_cast<int>(way(view, candidate, reach.probe, reach.planning));
    if (found >= best) continue;
    best = found;
    heading = candidate;
  }
  Angle error = heading - view.pose.heading;
  const bool backwards = best == static_cast<int>(Way::free) && magnitude(error) > kBackwards.raw();
  if (backwards) error += 180_deg;
  Manoeuvre away = steer(error, params.wheels.max_speed, params);
  if (backwards) away.forward = -away.forward;
  // Where the guard grants no way, a turn of less than a count would look like stalled wheels.
  if (magnitude(error) < nearest_facing(kFacing, params).raw()) away.turning = Speed{};
  return away;
}

}  // namespace whisker::planning

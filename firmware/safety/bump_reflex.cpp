#include "firmware/safety/bump_reflex.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::safety {
namespace {

constexpr int32_t kApart = 16;  // places, in a body radius
constexpr Angle kBehind = 60_deg;
constexpr Angle kTurned = 20_deg;
constexpr int32_t kReached = 8;  // of the distance between two places
constexpr int8_t kStillTicks = 3;
constexpr Duration kLongest = 60000_ms;  // longer phases count as this

Length way_back(const Params& params) noexcept { return params.body.radius / 2; }
Speed backwards(const Params& params) noexcept { return params.wheels.max_speed / 4; }

}  // namespace

void BumpReflex::enter(Phase phase) noexcept {
  planning::follow(kArrows, phase_, phase);
  phase_for_ = Duration{};
  still_ticks_ = 0;
}

/// Places are apart, except where the body has turned on the spot.
void BumpReflex::remember(const Pose& pose, Length apart) noexcept {
  const bool turned = magnitude(pose.heading - heading_) > kTurned.raw();
  if (turned) heading_ = pose.heading;
  if (places_kept_ > 0 && !farther(pose.at - places_[newest_], turned ? apart / kReached : apart)) return;
  newest_ = static_cast<int8_t>((newest_ + 1) % kPlaces);
  places_[newest_] = pose.at;
  heading_ = pose.heading;
  if (places_kept_ < kPlaces) ++places_kept_;
}

Angle BumpReflex::off_way_back(const Pose& pose) const noexcept {
  return bearing(places_[newest_] - pose.at) + 180_deg - pose.heading;
}

bool BumpReflex::has_way_back(const Pose& pose, Length apart) noexcept {
  for (; places_kept_ > 0; --places_kept_) {
    const bool reached = !farther(places_[newest_] - pose.at, apart / kReached);
    if (!reached && magnitude(off_way_back(pose)) < kBehind.raw()) return true;
    newest_ = static_cast<int8_t>((newest_ + kPlaces - 1) % kPlaces);
  }
  return false;
}

uint8_t BumpReflex::step(const Pose& pose, const Senses& senses, const Params& params) noexcept {
  const Length apart = params.body.radius / kApart;
  pressed_ = senses.pressed != 0;
  if (phase_ == Phase::watch) {
    remember(pose, apart);
    if (!pressed_ || !senses.mission) return 0;
    seen_ = 0;
    pressed_at_ = pose.at;
    enter(Phase::stop);
  }
  const uint8_t fresh = static_cast<uint8_t>(senses.pressed & ~seen_);
  seen_ = static_cast<uint8_t>(seen_ | fresh);
  phase_for_ = min(phase_for_ + senses.elapsed, kLongest);
  still_ticks_ = static_cast<int8_t>(!senses.still                ? 0
                                     : still_ticks_ < kStillTicks ? still_ticks_ + 1
                                                                  : kStillTicks);
  const Duration driving =
      milliseconds(multiply_divide(way_back(params).raw(), 1000, backwards(params).raw()));
  const Duration longest = derived::stalled_after(params) + (phase_ == Phase::back ? driving : Duration{});
  const bool late = phase_for_ > longest;
  switch (phase_) {
    case Phase::watch: break;
    case Phase::stop:
      if (still_ticks_ < kStillTicks && !late) break;
      retraces_ = has_way_back(pose, apart);
      enter(Phase::back);
      break;
    case Phase::back: {
      const bool far = farther(pose.at - pressed_at_, way_back(params));
      retraces_ = retraces_ && has_way_back(pose, apart);
      if (far || late || !senses.mission || (!retraces_ && !pressed_)) enter(Phase::wait);
      break;
    }
    case Phase::wait:
      if (!pressed_ && still_ticks_ == kStillTicks) enter(Phase::watch);
      break;
  }
  return fresh;
}

planning::VelocityRequest BumpReflex::request(const Pose& pose, const Params& params) const noexcept {
  if (!retraces_) return {-backwards(params), Speed{}, true};
  const Vec oldest = places_[(newest_ + kPlaces + 1 - places_kept_) % kPlaces];
  const Speed top = min(backwards(params), planning::approach_speed(norm(oldest - pose.at), params));
  const planning::Manoeuvre back = planning::steer(off_way_back(pose), top, params);
  const Speed fastest = params.wheels.max_turn_rate * (params.body.track / 2);
  return {-back.forward, limit(back.turning, fastest), true};
}

}  // namespace whisker::safety

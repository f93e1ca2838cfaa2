#include "firmware/safety/speed_limiter.hpp"

#include "firmware/safety/coasting.hpp"

namespace whisker::safety {
namespace {

constexpr Duration kCounted = 60000_ms;  // longer durations count as this

/// The body along its way. It checks places at most 2/9 of the radius and 14.4 degrees apart: see
/// guard_slack().
class Track {
 public:
  Track(const Pose& pose, const perception::LocalGrid& grid, perception::Avoid avoid,
        const BodyParams& body) noexcept
      : from_(pose.at), heading_(pose.heading), grid_(grid), avoid_(avoid), body_(body) {}

  /// False: it comes nearer to ground that must be avoided.
  bool follow(const Arc& arc) noexcept {
    int64_t turn = arc.turn(body_.track);
    Length length = arc.length();
    // Whole circles end where they begin.
    const int64_t circles = static_cast<int64_t>(magnitude(turn) >> 32) - 1;
    if (circles > 0) {
      const int64_t rest = turn - (turn < 0 ? -circles : circles) * (INT64_C(1) << 32);
      length = Length::from_raw(saturate32(quotient_64(length.raw() * rest, turn)));
      turn = rest;
    }
    int32_t steps = 1 + abs(length).raw() * 9 / (body_.radius.raw() * 2);
    const int32_t turns = 1 + narrow<int32_t>(magnitude(turn) / kStepTurn);
    // A turn on the spot reaches no other place.
    if (turns > steps && abs(length) >= perception::LocalGrid::kShortestStep) steps = turns;
    return steps_are_free(length, turn, steps);
  }

 private:
  static constexpr uint64_t kStepTurn = (UINT64_C(1) << 32) / 25;

  bool steps_are_free(Length length, int64_t turn, int32_t steps) noexcept {
    const Length step = length / steps;
    const int64_t step_turn = quotient(turn, steps);
    // The chord of a step is shorter by a^2 / 24, at most 0.26 %.
    const Angle half = Angle::from_raw(static_cast<uint32_t>(step_turn / 2));
    for (int32_t i = 0; i < steps; ++i) {
      way_ = way_ + polar(heading_ + half, step);
      heading_ += half * 2;
      if (grid_.approaches(from_, way_, grid_.reach().guard, avoid_)) return false;
    }
    return true;
  }

  const Vec from_;
  Angle heading_;
  const perception::LocalGrid& grid_;
  const perception::Avoid avoid_;
  const BodyParams& body_;
  Vec way_;
};

bool free(const WheelPair& command, const Pose& pose, const WheelState& wheels,
          const perception::LocalGrid& grid, const Params& params,
          perception::Avoid avoid = perception::Avoid::unclear) noexcept {
  Coasting coasting(command, wheels, params, (grid.reach().guard - params.body.radius) / 4);
  Track track(pose, grid, avoid, params.body);
  Length rolled;
  for (Arc arc; coasting.next(arc); rolled += arc.length()) {
    if (!track.follow(arc)) return false;
  }
  // A speed too small to matter within one way still adds up.
  const bool crawls = command.left + command.right != Speed{};
  constexpr Length kShortest = perception::LocalGrid::kShortestStep;
  // Twice, because the rounding of a direction may shorten it.
  if (!crawls || abs(rolled) >= kShortest * 2) return true;
  const Vec crawl = polar(pose.heading, rolled < Length{} ? -(kShortest * 2) : kShortest * 2);
  return !grid.approaches(pose.at, crawl, grid.reach().guard, avoid);
}

}  // namespace

WheelPair SpeedLimiter::step(const planning::VelocityRequest& request, const Pose& pose,
                             const WheelState& wheels, const perception::LocalGrid& grid, Duration elapsed,
                             const Params& params) noexcept {
  constexpr Q14 kFactors[] = {Q14::ratio(1, 1),  Q14::ratio(3, 4),  Q14::ratio(1, 2), Q14::ratio(3, 10),
                              Q14::ratio(3, 25), Q14::ratio(1, 25), Q14::ratio(0, 1)};
  // Braking goes on by the time that has passed. Another way begins where the wheels are, in a step that they
  // follow within a tick.
  const Speed slowed = params.wheels.max_acceleration * elapsed;
  const WheelPair braked = slew(wheels.commanded, {}, slowed);
  const Speed change =
      elapsed > params.safety.period ? params.wheels.max_acceleration * params.safety.period : slowed;
  brakes_ = true;
  if (!request.moves) {
    held_for_ = Duration{};
    return braked;
  }
  granted_ = Q14{};
  WheelPair command = braked;
  for (const Q14 factor : kFactors) {
    const WheelPair want =
        inverse_kinematics(request.forward * factor, request.turning, params.wheels.max_speed);
    const WheelPair next = slew(wheels.reached, want, change);
    if (!free(next, pose, wheels, grid, params)) continue;
    granted_ = factor;
    brakes_ = false;
    command = next;
    break;
  }
  const Speed creep = min(params.bumper.creep_speed, request.forward);
  if (request.forward * granted_ < creep) {
    const WheelPair want = inverse_kinematics(creep, request.turning, params.wheels.max_speed);
    const WheelPair next = slew(wheels.reached, want, change);
    if ((next.left + next.right) / 2 <= creep &&
        free(next, pose, wheels, grid, params, perception::Avoid::suspect)) {
      brakes_ = false;
      granted_ = Q14::ratio(creep.raw(), request.forward.raw());
      command = next;
    }
  }
  held_for_ = granted_ == Q14{} ? min(held_for_ + elapsed, kCounted) : Duration{};
  return command;
}

WheelPair SpeedLimiter::retrace(const planning::VelocityRequest& request, const WheelState& wheels,
                                Duration elapsed, const Params& params) noexcept {
  reset();
  const WheelPair want = inverse_kinematics(request.forward, request.turning, params.wheels.max_speed);
  return slew(wheels.reached, want, params.wheels.max_acceleration * min(elapsed, params.safety.period));
}

}  // namespace whisker::safety

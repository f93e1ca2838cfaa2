#include "firmware/safety/speed_limiter.hpp"

namespace whisker::safety {
namespace {

constexpr Duration kCounted = 60000_ms;  // longer durations count as this

/// Distance that a wheel still rolls: during its lag, at the new command until the next tick, while braking.
struct Brake {
  Length left;
  Length right;
};

Speed faster(WheelPair w) noexcept { return max(abs(w.left), abs(w.right)); }

Brake brake(WheelPair command, const WheelState& wheels, const Params& params) noexcept {
  const Duration hold = longest_gap(params);
  const int32_t twice = (params.wheels.max_acceleration * 2).raw();
  const int64_t fastest = faster(command).raw();
  const auto rolls = [&](Speed commanded, Speed rolling) {
    // Both wheels brake in the same time, that of the faster one; each covers half its speed times that time.
    const Length braking = Length::from_raw(saturate32(divide_rounded(commanded.raw() * fastest, twice)));
    return rolling * params.wheels.motor_lag + commanded * hold + braking;
  };
  return {rolls(command.left, wheels.rolling.left), rolls(command.right, wheels.rolling.right)};
}

bool free(const WheelPair& command, const Pose& pose, const WheelState& wheels,
          const perception::LocalGrid& grid, const Params& params,
          perception::Avoid avoid = perception::Avoid::unclear) noexcept {
  const Brake way = brake(command, wheels, params);
  const bool crawls = command.left + command.right != Speed{};
  const Length rolled = (way.left + way.right) / 2;
  constexpr Length kShortest = perception::LocalGrid::kShortestStep;
  const Length length =
      crawls && abs(rolled) < kShortest ? (rolled < Length{} ? -kShortest : kShortest) : rolled;
  const Angle backwards = length < Length{} ? 180_deg : Angle{};
  const Angle turn = angle_of(way.right - way.left, params.body.track);
  // 2/9 of the radius apart: between two such discs, the body's flank lies 0.6 % of the radius outside both.
  const int32_t samples = 1 + abs(length).raw() * 9 / (params.body.radius.raw() * 2);
  for (int32_t i = 1; i <= samples; ++i) {
    const Angle chord =
        Angle::from_raw(static_cast<uint32_t>(multiply_divide(turn.wrapped(), i, 2 * samples)));
    const Length far = Length::from_raw(multiply_divide(length.raw(), i, samples));
    if (grid.approaches(pose.at, pose.heading + chord + backwards, abs(far), grid.reach().guard, avoid))
      return false;
  }
  return true;
}

}  // namespace

WheelPair SpeedLimiter::step(const planning::VelocityRequest& request, const Pose& pose,
                             const WheelState& wheels, const perception::LocalGrid& grid, Duration elapsed,
                             const Params& params) noexcept {
  constexpr Q14 kFactors[] = {Q14::ratio(1, 1),  Q14::ratio(3, 4),  Q14::ratio(1, 2), Q14::ratio(3, 10),
                              Q14::ratio(3, 25), Q14::ratio(1, 25), Q14::ratio(0, 1)};
  const Speed change = params.wheels.max_acceleration * elapsed;
  if (!request.moves) {
    held_for_ = Duration{};
    return slew(wheels.commanded, {}, change);
  }
  granted_ = Q14{};
  WheelPair command = slew(wheels.commanded, {}, change);
  for (const Q14 factor : kFactors) {
    const WheelPair want =
        inverse_kinematics(request.forward * factor, request.turning, params.wheels.max_speed);
    const WheelPair next = slew(wheels.commanded, want, change);
    if (!free(next, pose, wheels, grid, params)) continue;
    granted_ = factor;
    command = next;
    break;
  }
  const Speed creep = min(params.bumper.creep_speed, request.forward);
  if (request.forward * granted_ < creep) {
    const WheelPair want = inverse_kinematics(creep, request.turning, params.wheels.max_speed);
    const WheelPair next = slew(wheels.commanded, want, change);
    if ((next.left + next.right) / 2 <= creep &&
        free(next, pose, wheels, grid, params, perception::Avoid::suspect)) {
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
  return slew(wheels.commanded, want, params.wheels.max_acceleration * elapsed);
}

}  // namespace whisker::safety

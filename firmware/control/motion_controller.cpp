#include "firmware/control/motion_controller.hpp"

namespace whisker::control {
namespace {

/// The highest speed from which `rest` is enough to stop: v with v^2 / 2a + v * settle = rest.
Speed approach_speed(Length rest, const Params& params) noexcept {
  if (rest <= Length{}) return Speed{};
  const int64_t a = params.wheels.max_acceleration.raw();
  const int64_t lead = (params.wheels.max_acceleration * params.motion.settle).raw();
  const uint32_t root = square_root(static_cast<uint64_t>(lead * lead + 2 * a * rest.raw()));
  return Speed::from_raw(saturate32(static_cast<int64_t>(root) - lead));
}

Speed signed_approach(Length rest, Speed limit_speed, const Params& params) noexcept {
  const Speed v = min(approach_speed(abs(rest), params), limit_speed);
  return rest < Length{} ? -v : v;
}

constexpr int32_t kStillPeriods = 3;

/// One tick of a first-order lag, by the trapezoid rule; a lag shorter than half a tick is none.
Speed follow(Speed rolling, Speed commanded, Duration elapsed, const Params& params) noexcept {
  const int32_t tick = elapsed.raw();
  const int32_t whole = 2 * params.wheels.motor_lag.raw() + tick;
  const int32_t part = 2 * tick < whole ? 2 * tick : whole;
  return rolling + Speed::from_raw(multiply_divide((commanded - rolling).raw(), part, whole));
}

void count_while(bool condition, Duration elapsed, Duration& time) noexcept {
  // It would wrap after 24 days: by then a fault has stopped the robot.
  const uint32_t longer = static_cast<uint32_t>(time.raw()) + static_cast<uint32_t>(elapsed.raw());
  time = Duration::from_raw(condition ? static_cast<int32_t>(longer) : 0);
}

}  // namespace

void MotionController::begin(const planning::Manoeuvre& manoeuvre, const Pose& pose) noexcept {
  if (manoeuvre.kind == planning::ManoeuvreKind::keep) return;
  const bool cruises_on =
      manoeuvre.kind == planning::ManoeuvreKind::cruise && current_.kind == planning::ManoeuvreKind::cruise;
  current_ = manoeuvre;
  if (cruises_on) return;
  origin_ = pose.at;
  finished_ = manoeuvre.kind == planning::ManoeuvreKind::stop;
  settled_ = false;
  still_for_ = stalled_for_ = waiting_for_ = Duration{};
  nearest_ = Length::from_raw(INT32_MAX);
}

void MotionController::approach(Length rest, Duration elapsed) noexcept {
  count_while(rest >= nearest_, elapsed, waiting_for_);
  nearest_ = min(nearest_, rest);
}

WheelPair MotionController::target(const Pose& pose, Duration elapsed, const Params& params) noexcept {
  if (finished_) return {};
  if (current_.kind == planning::ManoeuvreKind::cruise) {
    return inverse_kinematics(current_.forward, current_.turning, params.wheels.max_speed);
  }
  const Length half_track = params.body.track / 2;
  const Angle error = current_.heading - pose.heading;
  const Speed turn_limit = min(params.wheels.max_speed, params.wheels.max_turn_rate * half_track);
  if (current_.kind == planning::ManoeuvreKind::turn) {
    if (magnitude(error) <= params.motion.turn_tolerance.raw()) {
      finished_ = true;
      return {};
    }
    const Length way = arc(error, half_track);
    approach(abs(way), elapsed);
    return inverse_kinematics(Speed{}, signed_approach(way, turn_limit, params), params.wheels.max_speed);
  }
  const Length rest = current_.length - along(pose.at - origin_, current_.heading);
  if (rest <= params.motion.drive_tolerance) {
    finished_ = true;
    return {};
  }
  approach(rest, elapsed);
  const Speed forward = min(approach_speed(rest, params), params.wheels.max_speed);
  const Speed correction = signed_approach(arc(error, half_track), turn_limit, params);
  // Half the forward speed at most, so that the correction bends the path and never reverses a wheel.
  return inverse_kinematics(forward, limit(correction, forward / 2), params.wheels.max_speed);
}

WheelPair MotionController::step(const Pose& pose, const localization::CountStep* counts, bool paused,
                                 Duration elapsed, const Params& params) noexcept {
  const WheelPair want = paused ? WheelPair{} : target(pose, elapsed, params);
  speeds_ = slew(speeds_, want, params.wheels.max_acceleration * elapsed);
  rolling_ = {follow(rolling_.left, speeds_.left, elapsed, params),
              follow(rolling_.right, speeds_.right, elapsed, params)};

  if (counts == nullptr) {
    still_for_ = Duration{};
    settled_ = false;
    return speeds_;
  }
  const bool still = counts->left == 0 && counts->right == 0;
  const bool commanded = speeds_.left != Speed{} || speeds_.right != Speed{};
  count_while(still && !commanded, elapsed, still_for_);
  count_while(still && commanded, elapsed, stalled_for_);
  settled_ = finished_ && still_for_ >= params.safety.period * kStillPeriods;
  if (finished_) count_while(!commanded && !settled_, elapsed, waiting_for_);
  return speeds_;
}

hal::WheelSpeeds to_wire(WheelPair speeds) noexcept {
  constexpr int32_t kUmPerS = 100;
  return {saturate16(static_cast<int32_t>(divide_rounded(speeds.left.raw(), kUmPerS))),
          saturate16(static_cast<int32_t>(divide_rounded(speeds.right.raw(), kUmPerS)))};
}

}  // namespace whisker::control

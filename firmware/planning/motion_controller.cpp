#include "firmware/planning/motion_controller.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kStillPeriods = 3;
/// The guard holds a drive back for at most this long: by then the beams would have seen the unknown ground.
/// One that it lets creep ends when it comes no nearer.
constexpr int32_t kHeldPeriods = 20;
constexpr int32_t kHeldReadings = 4;

Speed signed_approach(Length rest, Speed limit_speed, Duration late, const Params& params) noexcept {
  const Speed v = min(stopping_speed(abs(rest), derived::settle_time(params) + late, params), limit_speed);
  return rest < Length{} ? -v : v;
}

Duration longest_hold(const Params& params) noexcept {
  return max(params.safety.period * kHeldPeriods,
             milliseconds(1000 / params.rangefinders.rate_hz) * kHeldReadings);
}

void count_while(bool condition, Duration elapsed, Duration& time) noexcept {
  // Saturates: it would wrap after 24 days, but a fault stops the robot before.
  const uint32_t longer = static_cast<uint32_t>(time.raw()) + static_cast<uint32_t>(elapsed.raw());
  time = Duration::from_raw(condition ? static_cast<int32_t>(longer) : 0);
}

}  // namespace

void MotionController::configure(const Params& params) noexcept {
  fastest_turning_ = params.wheels.max_turn_rate * (params.body.track / 2);
  fastest_on_the_spot_ = turn_rate(params) * (params.body.track / 2);
}

void MotionController::begin(const Manoeuvre& manoeuvre, const Pose& pose) noexcept {
  if (manoeuvre.kind == ManoeuvreKind::keep) return;
  const bool cruises_on = manoeuvre.kind == ManoeuvreKind::cruise && current_.kind == ManoeuvreKind::cruise;
  current_ = manoeuvre;
  if (cruises_on) return;
  origin_ = pose.at;
  finished_ = manoeuvre.kind == ManoeuvreKind::stop;
  cut_ = settled_ = false;
  still_for_ = waiting_for_ = Duration{};
  nearest_ = Length::from_raw(INT32_MAX);
}

void MotionController::interrupt() noexcept {
  if (current_.kind == ManoeuvreKind::drive && !finished_) finished_ = cut_ = true;
  settled_ = false;
  still_for_ = waiting_for_ = Duration{};
  nearest_ = Length::from_raw(INT32_MAX);
}

void MotionController::approach(Length rest, Duration elapsed) noexcept {
  count_while(rest >= nearest_, elapsed, waiting_for_);
  nearest_ = min(nearest_, rest);
}

VelocityRequest MotionController::request(const Pose& pose, Duration elapsed, Duration held_for,
                                          const Params& params) noexcept {
  // A turn that overshoots by more than what was left of it would never end.
  late_ = max(elapsed - params.safety.period, late_ * 7 / 8);
  if (finished_) return {};
  const Angle error = current_.heading - pose.heading;
  switch (current_.kind) {
    case ManoeuvreKind::keep:
    case ManoeuvreKind::stop: break;
    case ManoeuvreKind::turn: return turn(error, elapsed, params);
    case ManoeuvreKind::drive:
      if (held_for <= longest_hold(params) && !derived::outlasts_a_stall(waiting_for_, params)) {
        return drive(pose, error, elapsed, params);
      }
      finished_ = cut_ = true;
      waiting_for_ = Duration{};
      break;
    case ManoeuvreKind::cruise: return cruise();
  }
  return {};
}

/// If the turn rate exceeds the limit, both speeds are scaled, so that the path keeps its curvature.
VelocityRequest MotionController::cruise() const noexcept {
  const Speed most = current_.forward == Speed{} ? fastest_on_the_spot_ : fastest_turning_;
  const Speed turning = abs(current_.turning);
  if (turning <= most) return {current_.forward, current_.turning, true};
  return {Speed::from_raw(multiply_divide(current_.forward.raw(), most.raw(), turning.raw())),
          limit(current_.turning, most), true};
}

VelocityRequest MotionController::turn(Angle error, Duration elapsed, const Params& params) noexcept {
  if (magnitude(error) <= derived::turn_tolerance(params).raw()) {
    finished_ = true;
    return {};
  }
  const Length way = arc(error, params.body.track / 2);
  approach(abs(way), elapsed);
  const Speed fastest = min(params.wheels.max_speed, fastest_on_the_spot_);
  return {Speed{}, signed_approach(way, fastest, late_, params), true};
}

VelocityRequest MotionController::drive(const Pose& pose, Angle error, Duration elapsed,
                                        const Params& params) noexcept {
  const Length rest = current_.length - along(pose.at - origin_, current_.heading);
  if (rest <= derived::drive_tolerance(params)) {
    finished_ = true;
    return {};
  }
  approach(rest, elapsed);
  const Speed forward = min(approach_speed(rest, params), params.wheels.max_speed);
  const Speed fastest = min(params.wheels.max_speed, fastest_on_the_spot_);
  const Speed correction = signed_approach(arc(error, params.body.track / 2), fastest, late_, params);
  // At most half the forward speed, so that the correction never reverses a wheel.
  return {forward, limit(correction, forward / 2), true};
}

void MotionController::settle(const localization::CountStep* counts, bool commanded, Duration elapsed,
                              const Params& params) noexcept {
  if (counts == nullptr) {
    still_for_ = Duration{};
    settled_ = false;
    return;
  }
  const bool still = counts->left == 0 && counts->right == 0;
  count_while(still && !commanded, elapsed, still_for_);
  settled_ = finished_ && still_for_ >= params.safety.period * kStillPeriods;
  if (finished_) count_while(!commanded && !settled_, elapsed, waiting_for_);
}

}  // namespace whisker::planning

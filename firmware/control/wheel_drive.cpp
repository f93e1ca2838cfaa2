#include "firmware/control/wheel_drive.hpp"

namespace whisker::control {
namespace {

/// One tick of a first-order lag, by the trapezoidal rule; a lag below half a tick counts as 0.
Speed follow(Speed rolling, Speed commanded, Duration elapsed, const Params& params) noexcept {
  const int32_t tick = elapsed.raw();
  const int32_t whole = 2 * params.wheels.motor_lag.raw() + tick;
  if (whole <= 0) return commanded;
  const int32_t part = 2 * tick < whole ? 2 * tick : whole;
  return rolling + Speed::from_raw(multiply_divide((commanded - rolling).raw(), part, whole));
}

}  // namespace

void WheelDrive::pass(Duration elapsed, const Params& params) noexcept {
  WheelPair& rolling = state_.rolling;
  WheelPair& reached = state_.reached;
  // After a late tick, a command may be farther away than the wheels get in a tick.
  if (reached.left != state_.commanded.left || reached.right != state_.commanded.right) {
    reached = slew(reached, state_.commanded, params.wheels.max_acceleration * elapsed);
  }
  rolling = {follow(rolling.left, reached.left, elapsed, params),
             follow(rolling.right, reached.right, elapsed, params)};
}

bool WheelDrive::command(WheelPair speeds) noexcept {
  state_.commanded = speeds;
  sent_ = to_wire(speeds);
  if (drive_.command(sent_)) return true;
  state_.commanded = state_.reached = {};
  sent_ = {};
  return false;
}

hal::WheelSpeeds to_wire(WheelPair speeds) noexcept {
  constexpr int32_t kUmPerS = 100;
  return {saturate16(divide_rounded_32(speeds.left.raw(), kUmPerS)),
          saturate16(divide_rounded_32(speeds.right.raw(), kUmPerS))};
}

bool turns_on_wire(WheelPair speeds) noexcept {
  const hal::WheelSpeeds sent = to_wire(speeds);
  return sent.left != 0 || sent.right != 0;
}

}  // namespace whisker::control

#include "firmware/math/wheel_kinematics.hpp"

namespace whisker {
namespace {

Speed shrink(Speed v, Speed part, Speed whole) noexcept {
  return Speed::from_raw(multiply_divide(v.raw(), part.raw(), whole.raw()));
}

}  // namespace

WheelPair inverse_kinematics(Speed forward, Speed turning, Speed max_speed) noexcept {
  const WheelPair wheels{forward - turning, forward + turning};
  const Speed peak = max(abs(wheels.left), abs(wheels.right));
  if (peak <= max_speed) return wheels;
  return {shrink(wheels.left, max_speed, peak), shrink(wheels.right, max_speed, peak)};
}

WheelPair slew(const WheelPair& now, const WheelPair& want, Speed max_change) noexcept {
  const Speed left = want.left - now.left;
  const Speed right = want.right - now.right;
  const Speed peak = max(abs(left), abs(right));
  if (peak <= max_change) return want;
  return {now.left + shrink(left, max_change, peak), now.right + shrink(right, max_change, peak)};
}

}  // namespace whisker

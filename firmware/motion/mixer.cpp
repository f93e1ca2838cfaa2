#include "firmware/motion/mixer.hpp"

namespace whisker::motion {
namespace {

Speed shrink(Speed v, Speed part, Speed whole) noexcept {
  return Speed::from_raw(multiply_divide(v.raw(), part.raw(), whole.raw()));
}

}  // namespace

WheelPair mix(Speed forward, Speed turning, Speed max_speed) noexcept {
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

hal::WheelSpeeds to_wire(WheelPair speeds) noexcept {
  constexpr int32_t kUmPerS = 100;
  return {saturate16(static_cast<int32_t>(divide_rounded(speeds.left.raw(), kUmPerS))),
          saturate16(static_cast<int32_t>(divide_rounded(speeds.right.raw(), kUmPerS)))};
}

}  // namespace whisker::motion

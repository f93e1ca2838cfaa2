#include "firmware/localization/frame.hpp"

namespace whisker::localization {
namespace {

Vec turned(Vec v, Q30 cos, Q30 sin) noexcept {
  const int64_t x = v.x.raw();
  const int64_t y = v.y.raw();
  const auto part = [](int64_t sum) { return Length::from_raw(saturate32(scale_down<30>(sum))); };
  return {part(x * cos.raw() - y * sin.raw()), part(x * sin.raw() + y * cos.raw())};
}

}  // namespace

void Frame::tie(const Pose& inside, const Pose& outside) noexcept {
  inside_ = inside.at;
  outside_ = outside.at;
  turn_ = outside.heading - inside.heading;
  cos_ = cos(turn_);
  sin_ = sin(turn_);
}

Pose Frame::outward(const Pose& inside) const noexcept {
  return {outside_ + turned(inside.at - inside_, cos_, sin_), inside.heading + turn_};
}

bool Frame::aim(Vec goal, Vec& inside) noexcept {
  goal_ = goal;
  inside = inside_ + turned(goal - outside_, cos_, -sin_);
  return within(goal, kPlaceLimit) && within(inside, kBodyLimit);
}

}  // namespace whisker::localization

#include "firmware/localization/pose_history.hpp"

namespace whisker::localization {
namespace {

Pose between(const Pose& a, const Pose& b, int32_t part, int32_t whole) noexcept {
  const auto mix = [&](Length from, Length to) {
    return from + Length::from_raw(multiply_divide((to - from).raw(), part, whole));
  };
  const int32_t turn = multiply_divide((b.heading - a.heading).wrapped(), part, whole);
  return {{mix(a.at.x, b.at.x), mix(a.at.y, b.at.y)},
          a.heading + Angle::from_raw(static_cast<uint32_t>(turn))};
}

}  // namespace

void PoseHistory::add(const Pose& pose, Time now) noexcept {
  now_ = {pose, now};
  if (count_ > 0 && now - kept_[newest_].time < spacing_) return;
  newest_ = static_cast<int8_t>((newest_ + 1) % kKept);
  kept_[newest_] = now_;
  if (count_ < kKept) ++count_;
}

bool PoseHistory::at(Time then, Pose& out) const noexcept {
  if (count_ == 0) return false;
  const Instant* later = &now_;
  if (later->time - then <= Duration{}) {
    out = later->pose;
    return true;
  }
  for (int n = 0; n < count_; ++n) {
    const Instant& earlier = back(n);
    const Duration part = then - earlier.time;
    if (part >= Duration{}) {
      const Duration whole = later->time - earlier.time;
      out = whole == Duration{} ? later->pose : between(earlier.pose, later->pose, part.raw(), whole.raw());
      return true;
    }
    later = &earlier;
  }
  return false;
}

}  // namespace whisker::localization

#include "firmware/nav/circuit.hpp"

namespace whisker::nav {

using namespace literals;

namespace {

constexpr int64_t kDrift = 50;  // odometry is off by at most 1 / 50 of the way
constexpr uint64_t kDegree = (1_deg).raw();

}  // namespace

void Circuit::begin(Vec at, const Params& params) noexcept {
  *this = Circuit{};
  at_ = at;
  scale_ = for_body(params, 100_mm);
}

void Circuit::move(const Pose& pose, Length travel, Angle turn) noexcept {
  travel_um_ += travel.raw();
  turned_ += turn.wrapped();
  if (norm(pose.at - at_) > scale_ * 3) left_ = true;
}

bool Circuit::closed(const Pose& pose) const noexcept {
  if (!left_ || magnitude(turned_) < 300 * kDegree) return false;
  const Length near = min(scale_ * 7 / 2, scale_ * 3 / 2 + Length::from_raw(saturate32(travel_um_ / kDrift)));
  return norm(pose.at - at_) < near && magnitude(pose.heading - heading_) < (90_deg).raw();
}

bool Circuit::strays(const Pose& pose) noexcept {
  if (magnitude(turned_) < 360 * kDegree * static_cast<uint64_t>(laps_ + 1)) return false;
  const bool again = laps_ > 0 && norm(pose.at - lap_at_) < scale_ * 7 / 2;
  lap_at_ = pose.at;
  ++laps_;
  return again;
}

}  // namespace whisker::nav

#include "firmware/planning/boundary/loop_detector.hpp"

namespace whisker::planning {

using namespace literals;

namespace {

constexpr uint32_t kDrift = 50;  // odometry error: at most 1 / 50 of the travel
constexpr int32_t kMostLaps = 3;
constexpr int8_t kMostReturns = 3;
constexpr int32_t kNear = 3;  // scales: farther than any boundary that is followed
constexpr uint64_t kDegree = (1_deg).raw();
constexpr uint64_t kAskew = 15 * kDegree;  // of the headings at the two ends of a lap

}  // namespace

void LoopDetector::begin(const View& view, const Params& params) noexcept {
  *this = LoopDetector{};
  at_ = view.pose.at;
  last_ = view.pose.heading;
  began_um_ = view.travelled_um;
  bound_ = view.bound;
  scale_ = for_body(params, 100_mm);
}

void LoopDetector::move(const View& view) noexcept {
  turned_ += (view.pose.heading - last_).wrapped();
  last_ = view.pose.heading;
  const Length away = norm(view.pose.at - at_);
  farthest_ = max(farthest_, away);
  if (away > scale_ * 3) left_ = away_ = true;
  if (!view.sighted) return;
  bool near = false;
  for (const perception::ConeObservation& seen : view.observations) {
    near = near || (seen.hit && seen.free < scale_ * kNear);
  }
  if (near && seen_ < INT16_MAX) ++seen_;
  if (!near && seen_ > INT16_MIN) --seen_;
}

bool LoopDetector::closed(const View& view, Evidence evidence) noexcept {
  if (!follows_) {
    follows_ = true;
    heading_ = view.pose.heading;
    turned_ = 0;  // the turn into this direction is none of the boundary
  }
  const Length grown = view.bound - bound_;
  if (!left_ || grown > farthest_ / 2 || magnitude(view.pose.heading - heading_) >= (90_deg).raw())
    return false;
  const Length off = norm(view.pose.at - at_);
  const bool turned = magnitude(turned_) >= 300 * kDegree;
  const bool far = evidence == Evidence::place && farthest_ > scale_ * 15;
  if (!turned && !far) return returned(off);
  const Length drift = Length::from_raw(static_cast<int32_t>((view.travelled_um - began_um_) / kDrift));
  return off < max(min(scale_ * 7 / 2, scale_ * 3 / 2 + drift), grown);
}

bool LoopDetector::returned(Length off) noexcept {
  if (!away_ || off >= scale_ * 3 / 2) return false;
  away_ = false;
  return ++returns_ >= kMostReturns;
}

bool LoopDetector::may_part(Vec from, Vec to, Side wall) const noexcept {
  const bool within = turned_ * sign(wall) < 0;
  return norm((within ? from : to) - at_) <= farthest_;
}

bool LoopDetector::strays(const View& view, Evidence evidence) noexcept {
  const uint64_t whole = 360 * kDegree * static_cast<uint64_t>(laps_ + 1);
  const bool first = laps_ == 0;
  if (!first && magnitude(turned_) > whole - kAskew && rounds(view)) return true;
  if (magnitude(turned_) < (first ? whole : whole + kAskew)) return false;
  ++laps_;
  const bool by_place = evidence == Evidence::place;
  // Laps of less travel count together: one around a small obstacle, or around nothing, is shorter.
  if (by_place && !first && travelled(view) <= scale_ * 10) return false;
  const bool same_place = !first && norm(view.pose.at - lap_at_) < scale_ * 7 / 2;
  const bool again = same_place || (!by_place && laps_ > kMostLaps);
  lap_at_ = view.pose.at;
  lap_um_ = view.travelled_um;
  return again;
}

Length LoopDetector::travelled(const View& view) const noexcept {
  return Length::from_raw(saturate32(int64_t{view.travelled_um - lap_um_}));
}

bool LoopDetector::rounds(const View& view) const noexcept {
  return travelled(view) > scale_ * 10 && !farther(view.pose.at - lap_at_, scale_ * 3 / 2);
}

}  // namespace whisker::planning

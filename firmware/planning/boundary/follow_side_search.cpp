#include "firmware/planning/boundary/follow_side_search.hpp"

namespace whisker::planning {
namespace {

constexpr AngularRate kSweepRate = 2000_mrad_per_s;
constexpr int32_t kLast = 150;                     // degrees to each side within which exits are searched
constexpr int32_t kFine = 2 * kCandidateHeadings;  // a gap of body width is free at only a few headings
constexpr int32_t kSteps = kLast * kFine / 360;
constexpr Length kFarView = 800_mm;
// The outer rim of a side cone is 42.5 degrees ahead of the front; a path is as wide as the body.
constexpr int32_t kSeenBehind = 42;

constexpr Angle step_angle(int32_t n) noexcept { return Angle::turns(n, kFine); }
constexpr int32_t step_degrees(int32_t n) noexcept { return n * 360 / kFine; }

}  // namespace

void FollowSideSearch::begin(Angle blocked, Side first) noexcept {
  *this = FollowSideSearch{};
  blocked_ = blocked;
  now_ = first;
}

void FollowSideSearch::begin_on(Angle blocked, Side only) noexcept {
  begin(blocked, only);
  exit(opposite(only)).swept = true;
}

/// Includes the far view, because an exit into a pocket would cost a full sweep.
int32_t FollowSideSearch::cost(const Exit& e) noexcept {
  if (!e.free) return 1000;
  if (e.view == 0) return kLast + e.turn / 4;
  return e.view > e.turn ? e.view : e.turn;
}

void FollowSideSearch::judge(const View& view, int32_t swept) noexcept {
  const Reach& reach = view.local_grid->reach();
  Exit& mine = exit(now_);
  Share share(view);
  for (; !mine.free && candidate_ <= kSteps; ++candidate_) {
    if (!share.more()) return;
    const Angle heading = blocked_ + step_angle(candidate_ * sign(now_));
    const Way found = way(view, heading, reach.probe, reach.planning);
    if (found == Way::unknown && swept < step_degrees(candidate_) + kSeenBehind && swept < kLast + 15) return;
    if (found != Way::free) continue;
    mine.free = true;
    mine.heading = heading;
    mine.turn = narrow<int16_t>(step_degrees(candidate_));
  }
}

bool FollowSideSearch::step(const View& view, Twist& twist) noexcept {
  twist = {Speed{}, kSweepRate * sign(now_)};
  if (!view.sighted) return false;
  Exit& mine = exit(now_);
  const Exit& other = exit(opposite(now_));
  const int32_t swept = static_cast<int32_t>((view.pose.heading - blocked_).wrapped() * sign(now_) /
                                             static_cast<int32_t>((1_deg).raw()));
  if (mine.view == 0 && swept > 0 && swept <= kLast &&
      view.moving_scan.beam[hal::kFront].distance >= kFarView) {
    mine.view = narrow<int16_t>(swept);
  }
  judge(view, swept);
  const bool complete = mine.free && mine.view > 0;
  const bool worse = other.free && swept > cost(other);
  const bool over = swept >= kLast && (candidate_ > kSteps || mine.free);
  if (!complete && !worse && !over) return false;
  mine.swept = true;
  if (!other.swept) {
    now_ = opposite(now_);
    candidate_ = 1;
    return false;
  }
  const int32_t left = cost(exit(Side::left));
  const int32_t right = cost(exit(Side::right));
  if (left != right) {
    best_ = left < right ? Side::left : Side::right;
  } else {
    best_ = exit(Side::left).turn <= exit(Side::right).turn ? Side::left : Side::right;
  }
  return true;
}

}  // namespace whisker::planning

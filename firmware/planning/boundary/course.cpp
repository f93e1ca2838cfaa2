#include "firmware/planning/boundary/course.hpp"

#include "firmware/planning/candidate_headings.hpp"

namespace whisker::planning {
namespace {

constexpr Angle kStep = Angle::turns(1, kCandidateHeadings);
constexpr int kSteps = 10;  // to 75 degrees
constexpr Angle kFineStep = Angle::turns(1, 3 * kCandidateHeadings);
constexpr int32_t kNearlyFree = 5;  // cells; between two steps a gap of body width may be free
constexpr uint32_t kStraight = (1_deg).raw();
// An obstacle may start to move: if there is room, prefer a nearby course with more clearance.
constexpr Length kRoom = 30_mm;
constexpr int kRoomSteps = 6;  // to 45 degrees
// Numbers of candidates: these and the following ones.
constexpr int kRoomy = 2 + 2 * kRoomSteps;
constexpr int kAll = kRoomy + 2 + 2 * kSteps;
constexpr int kEnd = kAll + 4;

}  // namespace

/// Bends quickly and straightens slowly, so that the course does not oscillate beside an obstacle.
void Course::bend_towards(Angle wanted) noexcept {
  const int64_t change = int64_t{wanted.wrapped()} - bend_;
  const bool grows = magnitude(wanted.wrapped()) > magnitude(bend_);
  bend_ += static_cast<int32_t>(quotient(change * 3, grows ? 10 : 50));
}

struct Course::Candidate {
  Angle heading;
  Side wall = Side::left;
  bool roomy = false;  ///< with more room on both sides
  Why why = Why::none;
};

/// The n-th candidate: the headings with more room, then all, and then those beside the one that was nearly
/// free.
Course::Candidate Course::candidate(int n, Angle target, Side wall) const noexcept {
  if (n < kAll) return coarse(n, target, wall);
  const Candidate nearly = coarse(nearly_, target, wall);
  const Angle off = kFineStep * ((n - kAll) / 2 + 1);
  return {nearly.heading + (n % 2 == kAll % 2 ? -off : off), nearly.wall, false, Why::narrow};
}

/// Each round begins with that of the table and straight to the goal, and then comes nearer to the wall's
/// side and the other side in turn.
Course::Candidate Course::coarse(int n, Angle target, Side wall) const noexcept {
  const bool roomy = n < kRoomy;
  const int i = roomy ? n : n - kRoomy;
  if (i == 0) {
    const Why why = magnitude(bend_) > kStraight ? Why::table : Why::target_free;
    return {target + Angle::from_raw(static_cast<uint32_t>(bend_)), wall, roomy, why};
  }
  if (i == 1) return {target, wall, roomy, Why::narrow};
  const Angle off = kStep * (i / 2 * sign(wall));
  return i % 2 == 0 ? Candidate{target - off, wall, roomy, Why::narrow}
                    : Candidate{target + off, opposite(wall), roomy, Why::narrow};
}

bool Course::choose(const View& view, const Vec& to_goal, Angle deflection, const Params& params, Side& wall,
                    Decision& decision) noexcept {
  const Length distance = norm(to_goal);
  const Angle target = bearing(to_goal);
  if (!searches()) {
    bend_towards(view.moving_scan.beam[hal::kFront].distance >= distance ? Angle{} : deflection);
  }
  const Reach& reach = view.local_grid->reach();
  const Length length = min(reach.probe, distance);
  Share share(view);
  for (; next_ < kEnd; ++next_) {
    if (next_ == 0 || next_ == kRoomy) least_ = kNearlyFree + 1;
    if (next_ == kAll && least_ > kNearlyFree) break;
    if (!share.more()) return true;
    const Candidate now = candidate(next_, target, wall);
    const Length beside = now.roomy ? reach.planning + for_body(params, kRoom) : reach.planning;
    const int32_t cells =
        view.local_grid->suspects_along(view.pose.at, now.heading, length, beside, kNearlyFree + 1);
    if (cells == 0) {
      heading_ = now.heading;
      wall = now.wall;
      decision.why = now.why;
      next_ = 0;
      return true;
    }
    if (next_ >= kAll || cells >= least_) continue;
    least_ = narrow<int8_t>(cells);
    nearly_ = next_;
  }
  decision.why = Why::narrow;
  next_ = 0;
  return false;
}

}  // namespace whisker::planning

#include "firmware/planning/boundary/course.hpp"

#include "firmware/planning/candidate_headings.hpp"

namespace whisker::planning {
namespace {

constexpr Angle kStep = Angle::turns(1, kCandidateHeadings);
constexpr int32_t kSteps = 10;  // to 75 degrees
constexpr Angle kFineStep = Angle::turns(1, 3 * kCandidateHeadings);
constexpr int32_t kNearlyFree = 5;  // cells; between two steps a gap of body width may be free
constexpr uint32_t kStraight = (1_deg).raw();
// An obstacle may start to move: if there is room, prefer a nearby course with more clearance.
constexpr Length kRoom = 30_mm;
constexpr int32_t kRoomSteps = 6;  // to 45 degrees

}  // namespace

/// Bends quickly and straightens slowly, so that the course does not oscillate beside an obstacle.
void Course::bend_towards(Angle wanted) noexcept {
  const int64_t change = int64_t{wanted.wrapped()} - bend_;
  const bool grows = magnitude(wanted.wrapped()) > magnitude(bend_);
  bend_ += static_cast<int32_t>(quotient(change * 3, grows ? 10 : 50));
}

bool Course::choose(const View& view, const Vec& to_goal, Angle deflection, const Params& params, Side& wall,
                    Decision& decision) noexcept {
  const Length distance = norm(to_goal);
  const Angle target = bearing(to_goal);
  bend_towards(view.moving_scan.beam[hal::kFront].distance >= distance ? Angle{} : deflection);

  const Reach& reach = view.local_grid->reach();
  const Length length = min(reach.probe, distance);
  int32_t least = kNearlyFree + 1;
  Angle nearly;
  Side aside = wall;
  const auto in_the_way = [&](Angle heading, Length beside) {
    heading_ = heading;
    return view.local_grid->suspects_along(view.pose.at, heading, length, beside, kNearlyFree + 1);
  };
  const auto found = [&](Length beside, int32_t steps) {
    const auto passable = [&](Angle heading, Side then) {
      const int32_t cells = in_the_way(heading, beside);
      if (cells == 0) {
        wall = then;
      } else if (cells < least) {
        least = cells;
        nearly = heading;
        aside = then;
      }
      return cells == 0;
    };
    least = kNearlyFree + 1;
    decision.why = magnitude(bend_) > kStraight ? Why::table : Why::target_free;
    if (passable(target + Angle::from_raw(static_cast<uint32_t>(bend_)), wall)) return true;
    decision.why = Why::narrow;
    if (passable(target, wall)) return true;
    for (int32_t i = 1; i <= steps; ++i) {
      const Angle off = kStep * (i * sign(wall));
      if (passable(target - off, wall) || passable(target + off, opposite(wall))) return true;
    }
    return false;
  };
  if (found(reach.planning + for_body(params, kRoom), kRoomSteps) || found(reach.planning, kSteps))
    return true;
  if (least > kNearlyFree) return false;
  for (int32_t i = 1; i <= 2; ++i) {
    const Angle off = kFineStep * i;
    if (in_the_way(nearly - off, reach.planning) == 0 || in_the_way(nearly + off, reach.planning) == 0) {
      wall = aside;
      return true;
    }
  }
  return false;
}

}  // namespace whisker::planning

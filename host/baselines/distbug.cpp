#include "host/baselines/distbug.hpp"

namespace whisker::baselines {
namespace {

constexpr Length kStep = 100_mm;

}  // namespace

void DistBug::begin(const planning::View&) { least_ = distance(); }

Angle DistBug::course(const planning::View&) const { return bearing(to_goal()); }

planning::Side DistBug::hit(const planning::View& view) {
  least_ = min(least_, distance());
  return view.moving_scan.beam[hal::kLeft].distance > view.moving_scan.beam[hal::kRight].distance
             ? planning::Side::right
             : planning::Side::left;
}

bool DistBug::may_leave(const planning::View& view) {
  const Length free = max(seen_free(view), view.local_grid->reach().probe);
  const bool leaves = distance() - free <= least_ - kStep || free >= distance();
  least_ = min(least_, distance());
  return leaves;
}

}  // namespace whisker::baselines

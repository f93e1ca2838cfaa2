#include "host/lab/baselines/distbug.hpp"

namespace whisker::baselines {
namespace {

constexpr Length kStep = 100_mm;

}  // namespace

void DistBug::begin(const planning::View&, const planning::Target& target) { least_ = target.distance; }

Angle DistBug::course(const planning::View&, const planning::Target& target) const {
  return target.direction();
}

planning::Side DistBug::hit(const planning::View& view, const planning::Target& target) {
  least_ = min(least_, target.distance);
  return view.moving_scan.beam[hal::kLeft].distance > view.moving_scan.beam[hal::kRight].distance
             ? planning::Side::right
             : planning::Side::left;
}

bool DistBug::may_leave(const planning::View& view, const planning::Target& target) {
  const Length free = max(seen_free(view, target, params_), view.local_grid->reach().probe);
  const bool leaves = target.distance - free <= least_ - kStep || free >= target.distance;
  least_ = min(least_, target.distance);
  return leaves;
}

}  // namespace whisker::baselines

#include "host/baselines/distbug.hpp"

namespace whisker::baselines {
namespace {

constexpr Length kStep = 100_mm;

}  // namespace

void DistBug::begin(const nav::View&) { least_ = distance(); }

Angle DistBug::course(const nav::View&) const { return bearing(to_goal()); }

nav::Side DistBug::hit(const nav::View& view) {
  least_ = min(least_, distance());
  return view.sight.beam[hal::kLeft].distance > view.sight.beam[hal::kRight].distance ? nav::Side::right
                                                                                      : nav::Side::left;
}

bool DistBug::may_leave(const nav::View& view) {
  const Length free = max(seen_free(view), view.patch->reach().probe);
  const bool leaves = distance() - free <= least_ - kStep || free >= distance();
  least_ = min(least_, distance());
  return leaves;
}

}  // namespace whisker::baselines

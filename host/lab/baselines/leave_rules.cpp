#include "host/lab/baselines/leave_rules.hpp"

namespace whisker::baselines {
namespace {

// DistBug
constexpr Length kStep = 100_mm;
// Bug2
constexpr Length kLookAhead = 300_mm;
constexpr Length kNearer = 30_mm;
constexpr Length kOnLine = 30_mm;

}  // namespace

Length seen_free(const planning::View& view, const planning::Target& target, const Params& params) {
  Length free;
  for (int i = 0; i < hal::kBeams; ++i) {
    const perception::Echo& echo = view.moving_scan.beam[i];
    if (!perception::usable(echo.validity)) continue;
    const Angle axis = view.pose.heading + beam_axis(params.rangefinders, i);
    if (magnitude(axis - target.direction()) > (6_deg).raw()) continue;
    free = max(free, echo.distance - view.local_grid->reach().planning);
  }
  return free;
}

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

void Bug2::begin(const planning::View& view, const planning::Target& target) {
  from_ = view.pose.at;
  line_ = target.direction();
  length_ = target.distance;
}

Vec Bug2::on_line(const planning::View& view) const {
  const Vec v = view.pose.at - from_;
  return {along(v, line_), along(v, line_ + 90_deg)};
}

Angle Bug2::course(const planning::View& view, const planning::Target&) const {
  const Length done = min(on_line(view).x + kLookAhead, length_);
  return bearing(from_ + polar(line_, done) - view.pose.at);
}

planning::Side Bug2::hit(const planning::View& view, const planning::Target& target) {
  hit_distance_ = target.distance;
  offset_ = on_line(view).y;
  return planning::Side::right;
}

bool Bug2::may_leave(const planning::View& view, const planning::Target& target) {
  const Vec here = on_line(view);
  const bool crossed = (here.y < Length{}) != (offset_ < Length{});
  offset_ = here.y;
  if (!crossed && abs(here.y) > kOnLine) return false;
  return here.x >= Length{} && here.x <= length_ && target.distance < hit_distance_ - kNearer;
}

}  // namespace whisker::baselines

#include "host/lab/baselines/bug2.hpp"

namespace whisker::baselines {
namespace {

constexpr Length kLookAhead = 300_mm;
constexpr Length kNearer = 30_mm;
constexpr Length kOnLine = 30_mm;

}  // namespace

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

#include "host/harness/scenario/limits.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/shapes.hpp"

namespace whisker {
namespace {

constexpr double kSmallestArea = 1e-9;  // m^2
constexpr double kOffPath = 1e-3;       // m

}  // namespace

bool is_sound(const Bounds& b) { return b.min.x < b.max.x && b.min.y < b.max.y; }

bool is_within(sim::Vec2 p, const Bounds& b) {
  return b.min.x <= p.x && p.x <= b.max.x && b.min.y <= p.y && p.y <= b.max.y;
}

bool all_differ(const std::vector<sim::Vec2>& points) {
  const auto same = [](sim::Vec2 a, sim::Vec2 b) { return a.x == b.x && a.y == b.y; };
  return std::adjacent_find(points.begin(), points.end(), same) == points.end();
}

bool has_area(const std::vector<sim::Vec2>& polygon) {
  return std::fabs(signed_area(polygon)) >= kSmallestArea;
}

double off_path(const Mover& mover) { return distance(mover.center, mover.path); }

bool is_on_path(const Mover& mover) { return off_path(mover) <= kOffPath; }

}  // namespace whisker

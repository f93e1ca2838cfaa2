#include "host/harness/scenario/nearest.hpp"

#include <algorithm>
#include <limits>

#include "host/harness/scenario/shapes.hpp"

namespace whisker {
namespace {

double to_outline(sim::Vec2 p, const std::vector<sim::Vec2>& polygon) {
  const double open = distance(p, polygon);
  return std::min(open, distance(p, edge(polygon, polygon.size() - 1)));
}

double to_bounds(sim::Vec2 p, const Bounds& b) {
  return std::min({p.x - b.min.x, b.max.x - p.x, p.y - b.min.y, b.max.y - p.y});
}

}  // namespace

NearThing near_thing(const Scenario& s, sim::Vec2 p) {
  NearThing nearest{std::numeric_limits<double>::infinity(), "", 0};
  const auto consider = [&](double distance_m, const char* kind, std::size_t index) {
    if (distance_m < nearest.distance_m) nearest = {distance_m, kind, index + 1};
  };
  for (std::size_t i = 0; i < s.discs.size(); ++i) {
    consider(distance(p, s.discs[i].center) - s.discs[i].radius, "disc", i);
  }
  for (std::size_t i = 0; i < s.polygons.size(); ++i) {
    const double outline = to_outline(p, s.polygons[i]);
    consider(inside(p, s.polygons[i]) ? -outline : outline, "polygon", i);
  }
  for (std::size_t i = 0; i < s.walls.size(); ++i) consider(distance(p, s.walls[i]), "wall", i);
  for (std::size_t i = 0; i < s.movers.size(); ++i) {
    consider(distance(p, s.movers[i].center) - s.movers[i].radius_m, "mover", i);
  }
  if (s.bounds && to_bounds(p, *s.bounds) < nearest.distance_m) {
    nearest = {to_bounds(p, *s.bounds), "the bounds", 0};
  }
  return nearest;
}

bool start_is_free(const Scenario& s) {
  return near_thing(s, s.start.at).distance_m > s.robot.body.radius.raw() / 1e6;
}

}  // namespace whisker

#include "host/harness/worlds/scale.hpp"

#include <vector>

#include "host/harness/scenario/bearing.hpp"

namespace whisker::worlds {
namespace {

void scale(std::vector<sim::Vec2>& points, double factor) {
  for (sim::Vec2& p : points) p = p * factor;
}

}  // namespace

void scale_lengths(Scenario& s, double factor) {
  const bool ahead = s.start.heading == bearing(s.start.at, s.goal.at);
  s.start.at = s.start.at * factor;
  s.goal.at = s.goal.at * factor;
  s.goal.tolerance_m *= factor;
  // The rounded coordinates may change its last digit, and a file has no other form for such a heading.
  if (ahead) s.start.heading = bearing(s.start.at, s.goal.at);
  if (s.bounds) s.bounds = Bounds{s.bounds->min * factor, s.bounds->max * factor};
  for (sim::Disc& disc : s.discs) disc = {disc.center * factor, disc.radius * factor};
  for (auto& polygon : s.polygons) scale(polygon, factor);
  for (auto& wall : s.walls) scale(wall, factor);
  for (Mover& mover : s.movers) {
    mover.center = mover.center * factor;
    mover.radius_m *= factor;
    scale(mover.path, factor);
  }
}

}  // namespace whisker::worlds

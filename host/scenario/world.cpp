#include "host/scenario/world.hpp"

#include "host/scenario/shapes.hpp"

namespace whisker {

World make_world(const Scenario& scenario) {
  World world{scenario.discs, {}, scenario.movers};
  for (const auto& polygon : scenario.polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) world.segments.push_back(edge(polygon, i));
  }
  for (const auto& wall : scenario.walls) {
    for (std::size_t i = 0; i + 1 < wall.size(); ++i) world.segments.push_back({wall[i], wall[i + 1]});
  }
  if (scenario.bounds) {
    const auto [min, max] = *scenario.bounds;
    const std::vector<sim::Vec2> outline{min, {max.x, min.y}, max, {min.x, max.y}};
    for (std::size_t i = 0; i < outline.size(); ++i) world.segments.push_back(edge(outline, i));
  }
  return world;
}

}  // namespace whisker

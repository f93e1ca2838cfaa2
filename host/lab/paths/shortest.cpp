#include "host/lab/paths/shortest.hpp"

#include <cmath>

#include "host/harness/scenario/shapes.hpp"
#include "host/lab/paths/inflated.hpp"
#include "host/lab/paths/search.hpp"

namespace whisker::paths {

double length_m(const Leg& leg) {
  return leg.turn_rad == 0 ? distance(leg.from, leg.to) : std::fabs(leg.turn_rad) * leg.around.radius;
}

std::optional<Way> shortest_way(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m) {
  const Inflated inflated(world, from, to, radius_m);
  if (!inflated.free(from) || !inflated.free(to)) return std::nullopt;
  if (from.x == to.x && from.y == to.y) return Way{};
  return Search(inflated, from, to).shortest();
}

std::optional<double> shortest_path(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m) {
  const std::optional<Way> way = shortest_way(world, from, to, radius_m);
  return way ? std::optional(way->length_m) : std::nullopt;
}

}  // namespace whisker::paths

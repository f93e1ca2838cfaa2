#include "host/harness/run/sim_world.hpp"

#include <limits>

#include "host/harness/scenario/shapes.hpp"

namespace whisker {
namespace {

/// Arc length along the path to its point nearest to p, m.
double arc_of(const std::vector<sim::Vec2>& path, sim::Vec2 p) {
  double best = std::numeric_limits<double>::infinity();
  double arc = 0;
  double before = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const sim::Segment leg{path[i - 1], path[i]};
    const sim::Vec2 along = leg.b - leg.a;
    const double length = distance(leg.a, leg.b);
    if (distance(p, leg) < best) {
      best = distance(p, leg);
      const double t = length > 0 ? sim::dot(p - leg.a, along) / length : 0;
      arc = before + (t < 0 ? 0 : t > length ? length : t);
    }
    before += length;
  }
  return arc;
}

}  // namespace

SimWorld::SimWorld(const Scenario& scenario) : world_(make_world(scenario)) {
  for (const Mover& m : world_.movers) {
    movers_.push_back({m.path.data(), m.path.size(), m.radius_m, m.speed_mps, arc_of(m.path, m.center)});
  }
  view_ = {world_.discs.data(),
           world_.discs.size(),
           world_.segments.data(),
           world_.segments.size(),
           movers_.data(),
           movers_.size(),
           world_.soft.empty() ? nullptr : world_.soft.data()};
}

void adopt_world(Scenario& to, const Scenario& from) {
  to.goal = from.goal;
  to.bounds = from.bounds;
  to.discs = from.discs;
  to.polygons = from.polygons;
  to.walls = from.walls;
  to.movers = from.movers;
}

}  // namespace whisker

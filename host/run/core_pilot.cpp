#include "host/run/core_pilot.hpp"

#include <utility>

#include "firmware/nav/map_planner.hpp"
#include "firmware/nav/skirt.hpp"
#include "firmware/nav/thesis.hpp"
#include "host/run/spec.hpp"

namespace whisker {
namespace {

/// As nav::TableMap, with a guide that can be watched.
template <int kBytes>
struct ShownMap {
  ShownMap(const Params& params, const fuzzy::Engine::Table& table)
      : law(table), map(params), guide(map.guide), planner(params, law, &guide) {}
  nav::TableBend law;
  nav::MapOf<kBytes> map;
  ShownGuide guide;
  nav::SkirtPlanner planner;
};

}  // namespace

CorePilot::CorePilot(const Scenario& scenario, SeenPlanner planner, sim::Plant& plant)
    : board_(plant),
      planner_(std::move(planner)),
      shown_(*planner_.planner),
      robot_(board_, board_, shown_, scenario.robot) {
  robot_.place(fixed_pose(scenario.start));
  robot_.set_goal(fixed_goal(scenario.goal));
}

nav::Goal fixed_goal(const Goal& goal) {
  return {fixed_pose({goal.at, 0}).at, fixed_pose({{goal.tolerance_m, 0}, 0}).at.x};
}

SeenPlanner make_core_planner(PlannerKind kind, const Params& params, const fuzzy::Engine::Table& table) {
  if (kind == PlannerKind::skirt) {
    const auto skirt = std::make_shared<nav::TableSkirt>(params, table);
    return {{skirt, &skirt->planner}};
  }
  if (kind == PlannerKind::thesis) return {std::make_shared<nav::ThesisPlanner>(params, table)};
  return nav::with_map_of<SeenPlanner>(map_bytes(kind), [&](auto bytes) -> SeenPlanner {
    const auto map = std::make_shared<ShownMap<bytes.kValue>>(params, table);
    return {{map, &map->planner}, &map->guide};
  });
}

std::optional<map::Shape> map_shape(PlannerKind kind) {
  return nav::with_map_of<std::optional<map::Shape>>(map_bytes(kind),
                                                     [](auto bytes) { return nav::kMapShape<bytes.kValue>; });
}

}  // namespace whisker

#include "host/run/core_pilot.hpp"

#include <utility>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/planning/global/map_planner.hpp"
#include "firmware/planning/thesis/thesis_planner.hpp"
#include "host/run/spec.hpp"

namespace whisker {
namespace {

/// As planning::TableMap, with a guide that can be watched.
template <int kBytes>
struct ShownMap {
  ShownMap(const Params& params, const fuzzy::Engine::Table& table)
      : law(table), map(params), guide(map.guide), planner(params, law, &guide) {}
  planning::TableDeflection law;
  planning::MapOf<kBytes> map;
  ShownGuide guide;
  planning::BoundaryPlanner planner;
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

planning::Goal fixed_goal(const Goal& goal) {
  return {fixed_pose({goal.at, 0}).at, fixed_pose({{goal.tolerance_m, 0}, 0}).at.x};
}

SeenPlanner make_core_planner(PlannerKind kind, const Params& params, const fuzzy::Engine::Table& table) {
  if (kind == PlannerKind::skirt) {
    const auto skirt = std::make_shared<planning::TableBoundaryPlanner>(params, table);
    return {{skirt, &skirt->planner}};
  }
  if (kind == PlannerKind::thesis) return {std::make_shared<planning::ThesisPlanner>(params, table)};
  return planning::with_map_of<SeenPlanner>(map_bytes(kind), [&](auto bytes) -> SeenPlanner {
    const auto map = std::make_shared<ShownMap<bytes.kValue>>(params, table);
    return {{map, &map->planner}, &map->guide};
  });
}

std::optional<planning::GridShape> map_shape(PlannerKind kind) {
  return planning::with_map_of<std::optional<planning::GridShape>>(
      map_bytes(kind), [](auto bytes) { return planning::kMapShape<bytes.kValue>; });
}

}  // namespace whisker

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

template <int kBytes>
SeenPlanner with_map(const Params& params, const fuzzy::Engine::Table& table) {
  const auto map = std::make_shared<ShownMap<kBytes>>(params, table);
  return {{map, &map->planner}, &map->guide};
}

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
  switch (map_bytes(kind)) {
    case 1024: return with_map<1024>(params, table);
    case 2048: return with_map<2048>(params, table);
    case 4096: return with_map<4096>(params, table);
    case 8192: return with_map<8192>(params, table);
    case 16384: return with_map<16384>(params, table);
    default: return {};
  }
}

std::optional<map::Shape> map_shape(PlannerKind kind) {
  switch (map_bytes(kind)) {
    case 1024: return nav::kMapShape<1024>;
    case 2048: return nav::kMapShape<2048>;
    case 4096: return nav::kMapShape<4096>;
    case 8192: return nav::kMapShape<8192>;
    case 16384: return nav::kMapShape<16384>;
    default: return std::nullopt;
  }
}

}  // namespace whisker

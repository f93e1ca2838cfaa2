#include "host/run/planners.hpp"

#include "host/baselines/deflection_laws.hpp"
#include "host/baselines/bug2.hpp"
#include "host/baselines/bug_planner.hpp"
#include "host/baselines/distbug.hpp"
#include "host/baselines/wall_follower.hpp"
#include "host/run/core_pilot.hpp"

namespace whisker {
namespace {

/// A planner that lives and dies together with the rule or the law that is its member.
template <class Whole>
std::shared_ptr<planning::Planner> planner_of(const Params& params) {
  const auto whole = std::make_shared<Whole>(params);
  return {whole, &whole->planner};
}

}  // namespace

SeenPlanner make_seen_planner(PlannerKind kind, const Params& params) {
  switch (kind) {
    case PlannerKind::skirt:
    case PlannerKind::thesis:
    case PlannerKind::map:
    case PlannerKind::map_1024:
    case PlannerKind::map_4096:
    case PlannerKind::map_8192:
    case PlannerKind::map_16384: return make_core_planner(kind, params, fuzzy::kDefaultTable);
    case PlannerKind::bug2: return {planner_of<baselines::RuledPlanner<baselines::Bug2>>(params)};
    case PlannerKind::distbug: return {planner_of<baselines::RuledPlanner<baselines::DistBug>>(params)};
    case PlannerKind::wall_follower:
      return {planner_of<baselines::RuledPlanner<baselines::WallFollower>>(params)};
    case PlannerKind::fan:
      return {planner_of<baselines::DeflectedBoundaryPlanner<baselines::NoDeflection>>(params)};
    case PlannerKind::repulsion:
      return {planner_of<baselines::DeflectedBoundaryPlanner<baselines::RepulsionDeflection>>(params)};
  }
  return {};
}

std::shared_ptr<planning::Planner> make_planner(PlannerKind kind, const Params& params) {
  return make_seen_planner(kind, params).planner;
}

const char* name(PlannerKind kind) {
  switch (kind) {
    case PlannerKind::skirt: return "skirt";
    case PlannerKind::thesis: return "thesis";
    case PlannerKind::map: return "map";
    case PlannerKind::map_1024: return "map-1024";
    case PlannerKind::map_4096: return "map-4096";
    case PlannerKind::map_8192: return "map-8192";
    case PlannerKind::map_16384: return "map-16384";
    case PlannerKind::bug2: return "bug2";
    case PlannerKind::distbug: return "distbug";
    case PlannerKind::wall_follower: return "wall-follower";
    case PlannerKind::fan: return "fan";
    case PlannerKind::repulsion: return "repulsion";
  }
  return "?";
}

std::optional<PlannerKind> planner_named(std::string_view text) {
  if (text == "boundary") return PlannerKind::skirt;
  for (const PlannerKind kind : kPlanners) {
    if (text == name(kind)) return kind;
  }
  return std::nullopt;
}

}  // namespace whisker

#include "host/run/planners.hpp"

#include "host/baselines/bends.hpp"
#include "host/baselines/bug2.hpp"
#include "host/baselines/distbug.hpp"
#include "host/baselines/wall_follower.hpp"
#include "host/run/core_pilot.hpp"

namespace whisker {
namespace {

/// The planner and the law that bends its course live and die together.
template <class Bend>
std::shared_ptr<planning::Planner> bent_skirt(const Params& params) {
  const auto skirt = std::make_shared<baselines::DeflectedBoundaryPlanner<Bend>>(params);
  return {skirt, &skirt->planner};
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
    case PlannerKind::bug2: return {std::make_shared<baselines::Bug2>(params)};
    case PlannerKind::distbug: return {std::make_shared<baselines::DistBug>(params)};
    case PlannerKind::wall_follower: return {std::make_shared<baselines::WallFollower>(params)};
    case PlannerKind::fan: return {bent_skirt<baselines::NoDeflection>(params)};
    case PlannerKind::repulsion: return {bent_skirt<baselines::RepulsionDeflection>(params)};
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

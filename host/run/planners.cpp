#include "host/run/planners.hpp"

#include "firmware/nav/skirt.hpp"
#include "firmware/nav/thesis.hpp"
#include "host/baselines/bends.hpp"
#include "host/baselines/bug2.hpp"
#include "host/baselines/distbug.hpp"
#include "host/baselines/wall_follower.hpp"

namespace whisker {
namespace {

/// The planner and the law that bends its course live and die together.
template <class Skirt, class... Table>
std::shared_ptr<nav::Planner> make_skirt(const Params& params, const Table&... table) {
  const auto skirt = std::make_shared<Skirt>(params, table...);
  return {skirt, &skirt->planner};
}

}  // namespace

std::shared_ptr<nav::Planner> make_planner(PlannerKind kind, const Params& params) {
  switch (kind) {
    case PlannerKind::skirt: return make_skirt<nav::TableSkirt>(params, fuzzy::kDefaultTable);
    case PlannerKind::thesis: return std::make_shared<nav::ThesisPlanner>(params, fuzzy::kDefaultTable);
    case PlannerKind::bug2: return std::make_shared<baselines::Bug2>(params);
    case PlannerKind::distbug: return std::make_shared<baselines::DistBug>(params);
    case PlannerKind::wall_follower: return std::make_shared<baselines::WallFollower>(params);
    case PlannerKind::fan: return make_skirt<baselines::BentSkirt<baselines::FanBend>>(params);
    case PlannerKind::repulsion: return make_skirt<baselines::BentSkirt<baselines::RepulsionBend>>(params);
  }
  return nullptr;
}

const char* name(PlannerKind kind) {
  switch (kind) {
    case PlannerKind::skirt: return "skirt";
    case PlannerKind::thesis: return "thesis";
    case PlannerKind::bug2: return "bug2";
    case PlannerKind::distbug: return "distbug";
    case PlannerKind::wall_follower: return "wall-follower";
    case PlannerKind::fan: return "fan";
    case PlannerKind::repulsion: return "repulsion";
  }
  return "?";
}

std::optional<PlannerKind> planner_named(std::string_view text) {
  for (const PlannerKind kind : kPlanners) {
    if (text == name(kind)) return kind;
  }
  return std::nullopt;
}

}  // namespace whisker

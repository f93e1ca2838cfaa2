#include "host/run/planners.hpp"

#include "firmware/nav/skirt.hpp"
#include "firmware/nav/thesis.hpp"

namespace whisker {

std::shared_ptr<nav::Planner> make_planner(PlannerKind kind, const Params& params) {
  switch (kind) {
    case PlannerKind::skirt: return std::make_shared<nav::SkirtPlanner>(params, fuzzy::kDefaultTable);
    case PlannerKind::thesis: return std::make_shared<nav::ThesisPlanner>(params, fuzzy::kDefaultTable);
  }
  return nullptr;
}

const char* name(PlannerKind kind) {
  switch (kind) {
    case PlannerKind::skirt: return "skirt";
    case PlannerKind::thesis: return "thesis";
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

/// The planners by name.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "firmware/nav/planner.hpp"
#include "firmware/params.hpp"

namespace whisker {

enum class PlannerKind { skirt, thesis };
constexpr PlannerKind kPlanners[] = {PlannerKind::skirt, PlannerKind::thesis};

/// With the default response table. The parameters must outlive the planner.
std::shared_ptr<nav::Planner> make_planner(PlannerKind kind, const Params& params);

/// As on the command line: "skirt".
const char* name(PlannerKind kind);
std::optional<PlannerKind> planner_named(std::string_view name);

}  // namespace whisker

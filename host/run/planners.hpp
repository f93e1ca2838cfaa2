/// The planners by name.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "firmware/nav/planner.hpp"
#include "firmware/params.hpp"

namespace whisker {

enum class PlannerKind { skirt, thesis, bug2, distbug, wall_follower, fan, repulsion };
constexpr PlannerKind kPlanners[] = {PlannerKind::skirt,    PlannerKind::thesis,        PlannerKind::bug2,
                                     PlannerKind::distbug,  PlannerKind::wall_follower, PlannerKind::fan,
                                     PlannerKind::repulsion};

/// With the default response table. The parameters must outlive the planner.
std::shared_ptr<nav::Planner> make_planner(PlannerKind kind, const Params& params);

/// One to compare with, for hosts only.
constexpr bool is_baseline(PlannerKind kind) { return kind > PlannerKind::thesis; }

/// As on the command line: "skirt".
const char* name(PlannerKind kind);
std::optional<PlannerKind> planner_named(std::string_view name);

}  // namespace whisker

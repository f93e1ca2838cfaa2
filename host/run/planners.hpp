/// The planners by name.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "firmware/params.hpp"
#include "firmware/planning/default_planner.hpp"
#include "firmware/planning/planner.hpp"
#include "host/run/shown_guide.hpp"

namespace whisker {

enum class PlannerKind {
  skirt,
  thesis,
  map,  ///< 2048 bytes
  map_1024,
  map_4096,
  map_8192,
  map_16384,
  bug2,
  distbug,
  wall_follower,
  fan,
  repulsion
};
constexpr PlannerKind kPlanners[] = {
    PlannerKind::skirt,    PlannerKind::thesis,        PlannerKind::map,       PlannerKind::map_1024,
    PlannerKind::map_4096, PlannerKind::map_8192,      PlannerKind::map_16384, PlannerKind::bug2,
    PlannerKind::distbug,  PlannerKind::wall_follower, PlannerKind::fan,       PlannerKind::repulsion};

/// Size of its map in bytes; 0: it has none.
constexpr int map_bytes(PlannerKind kind) {
  switch (kind) {
    case PlannerKind::map: return 2048;
    case PlannerKind::map_1024: return 1024;
    case PlannerKind::map_4096: return 4096;
    case PlannerKind::map_8192: return 8192;
    case PlannerKind::map_16384: return 16384;
    default: return 0;
  }
}

/// The default planner: see firmware/planning/default_planner.hpp.
constexpr PlannerKind default_planner() {
  for (const PlannerKind kind : kPlanners) {
    if (map_bytes(kind) == planning::kDefaultMapBytes) return kind;
  }
  return PlannerKind::skirt;
}
constexpr PlannerKind kDefaultPlanner = default_planner();
static_assert(map_bytes(kDefaultPlanner) == planning::kDefaultMapBytes);

/// A planner and the global planner in it.
struct SeenPlanner {
  std::shared_ptr<planning::Planner> planner;
  const ShownGuide* guide = nullptr;  ///< null without a map; lives as long as the planner
};

/// With the default response table. The parameters must outlive the planner.
SeenPlanner make_seen_planner(PlannerKind kind, const Params& params);
std::shared_ptr<planning::Planner> make_planner(PlannerKind kind, const Params& params);

/// A planner for comparison, on the host only.
constexpr bool is_baseline(PlannerKind kind) { return kind >= PlannerKind::bug2; }

/// As on the command line: "skirt".
const char* name(PlannerKind kind);
/// "boundary" is another name for "skirt".
std::optional<PlannerKind> planner_named(std::string_view name);

}  // namespace whisker

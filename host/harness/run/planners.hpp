/// The planners by name: those of the core (firmware/planning/planners.hpp), and what the program adds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/fuzzy/engine.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/default_planner.hpp"
#include "firmware/planning/planners.hpp"
#include "host/harness/run/recording_guide.hpp"

namespace whisker {

/// The response table is not part of the kind: two kinds are equal whatever their tables.
struct PlannerKind {
  int number = 0;  ///< in the core's list; added planners follow it
  std::int32_t map_bytes = 0;
  const fuzzy::Engine::Table* table = &fuzzy::kDefaultTable;  ///< must outlive the planner
  bool table_chosen = false;                                  ///< by the user, who wants it to drive

  static const PlannerKind boundary, thesis, map;
  friend constexpr bool operator==(PlannerKind a, PlannerKind b) {
    return a.number == b.number && a.map_bytes == b.map_bytes;
  }
  friend constexpr bool operator!=(PlannerKind a, PlannerKind b) { return !(a == b); }
};

/// The core's planner with this name, and this size of map if it has one.
constexpr PlannerKind core_planner(std::string_view name, std::int32_t map_bytes = 0) {
  PlannerKind found{-1, 0};
  planning::for_each_planner([&](const planning::PlannerInfo& info, auto type) {
    if (info.name == name && type.kMapBytes == map_bytes) found = {info.number, type.kMapBytes};
  });
  return found;
}
inline constexpr PlannerKind PlannerKind::boundary = core_planner("skirt");
inline constexpr PlannerKind PlannerKind::thesis = core_planner("thesis");
inline constexpr PlannerKind PlannerKind::map = core_planner("map", planning::kUsualMapBytes);

/// The default planner: see firmware/planning/default_planner.hpp.
constexpr PlannerKind kDefaultPlanner =
    planning::kDefaultMapBytes == 0 ? PlannerKind::boundary : core_planner("map", planning::kDefaultMapBytes);

/// A planner and the global planner in it.
struct RecordedPlanner {
  std::shared_ptr<planning::Planner> planner;
  const RecordingGuide* guide = nullptr;  ///< null without a map; lives as long as the planner
};

/// A planner for comparison, on the host only. It has no response table.
struct Baseline {
  const char* name;
  std::shared_ptr<planning::Planner> (*make)(const Params& params);
};
/// Adds them to the list, before any other function here is called. They must outlive it.
void add_baselines(const Baseline* baselines, std::size_t count);

/// The parameters must outlive the planner.
RecordedPlanner make_recorded_planner(PlannerKind kind, const Params& params);
std::shared_ptr<planning::Planner> make_planner(PlannerKind kind, const Params& params);

/// All planners, those of the core first.
std::vector<PlannerKind> planners();
bool is_baseline(PlannerKind kind);
/// As on the command line: "skirt", "map", and "map-1024" for another size of map.
const std::string& name(PlannerKind kind);
/// fuzzy::digest() of its response table; 0: it has none.
std::uint32_t rules_digest(PlannerKind kind);
/// Another accepted name; empty: none.
std::string_view alias(PlannerKind kind);
/// Finds a planner by its name or its alias.
std::optional<PlannerKind> planner_named(std::string_view name);

}  // namespace whisker

/// The list of the core's planners, for the command line, campaigns, the bus, the playground and the golden
/// streams. docs/development.md shows how to add one.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/planning/global/map_planner.hpp"
#include "firmware/planning/thesis/thesis_planner.hpp"

namespace whisker::planning {

struct PlannerInfo {
  uint8_t number;     ///< in a golden stream
  const char* name;   ///< on the command line, in traces and on pages
  const char* alias;  ///< accepted alternative name; nullptr: none
  const char* about;  ///< why it avoids deadlocks, or when it does not: shown by the playground
};

/// The constructor of `Made` takes parameters and response table, which must outlive it.
template <class Made>
struct PlannerType {
  using Type = Made;
  static constexpr int32_t kMapBytes = 0;  ///< of its map; 0: it has none
};
template <int kBytes>
struct PlannerType<TableMapPlanner<kBytes>> {
  using Type = TableMapPlanner<kBytes>;
  static constexpr int32_t kMapBytes = kBytes;
};

/// Calls visit(PlannerInfo, PlannerType): for a planner with a map, once for each size of map.
template <class Visit>
constexpr void for_each_planner(Visit&& visit) noexcept {
  visit(
      PlannerInfo{
          0, "skirt", "boundary",
          "Where the path to the goal is blocked, the robot follows the boundary of the obstacle. It leaves "
          "it only where it is nearer to the goal than ever before. So each boundary brings it nearer, and "
          "no dead end can trap it. A closed loop without such a place means that no path exists."},
      PlannerType<TableBoundaryPlanner>{});
  visit(PlannerInfo{1, "thesis", nullptr,
                    "The robot may get stuck: it leaves a boundary as soon as the goal direction is clear, "
                    "nearer to the goal or not, and can enter the same trap again and again. The boundary "
                    "planner does not."},
        PlannerType<ThesisPlanner>{});
  constexpr PlannerInfo kMap{
      2, "map", nullptr,
      "The robot follows a plan on a map of what the beams have seen, as long as this brings it nearer to "
      "its goal. Otherwise it falls back to boundary following, by the rule of the boundary planner. The map "
      "resumes where the robot is nearer to the goal than ever before."};
  for_each_map([&](auto map) { visit(kMap, PlannerType<TableMapPlanner<map.kBytes>>{}); });
}

/// Returns make(PlannerType) for the planner with this number, with a map of this size if it has one; R() if
/// there is no such planner.
template <class R, class Make>
constexpr R with_planner(int number, int32_t map_bytes, const Make& make) noexcept {
  R made{};
  for_each_planner([&](const PlannerInfo& info, auto type) {
    if (info.number == number && (type.kMapBytes == 0 || type.kMapBytes == map_bytes)) made = make(type);
  });
  return made;
}

/// Size of the largest planner whose map has at most this many bytes.
constexpr size_t largest_planner(int32_t most_map_bytes) noexcept {
  size_t most = 0;
  for_each_planner([&](const PlannerInfo&, auto type) {
    constexpr size_t kSize = sizeof(typename decltype(type)::Type);
    if (type.kMapBytes <= most_map_bytes && kSize > most) most = kSize;
  });
  return most;
}

/// The planner in an object of PlannerType::Type: the object itself, or its member.
inline Planner& planner_in(Planner& made) noexcept { return made; }
template <class Made>
auto planner_in(Made& made) noexcept -> decltype((made.planner)) {
  return made.planner;
}

}  // namespace whisker::planning

/// The planner of those who choose none.
#pragma once

#include "firmware/planning/global/map_planner.hpp"

namespace whisker::planning {

/// Bytes of the largest map that the target has room for beside all else; 0: none. A build may say it.
#ifdef WHISKER_MAP_BYTES
constexpr int kRoomForMap = WHISKER_MAP_BYTES;
#else
constexpr int kRoomForMap = 16384;
#endif

/// Bytes of the map of the default planner; 0: it has none, and is the boundary planner. A build may say it.
#ifdef WHISKER_DEFAULT_MAP_BYTES
constexpr int kDefaultMapBytes = WHISKER_DEFAULT_MAP_BYTES;
#else
constexpr int kDefaultMapBytes = kRoomForMap >= kUsualMapBytes ? kUsualMapBytes : 0;
#endif
static_assert(kDefaultMapBytes <= kRoomForMap);

/// The planner with a map of so many bytes, or without.
template <int kMapBytes>
struct PlannerWithMap {
  using Type = TableMapPlanner<kMapBytes>;
};
template <>
struct PlannerWithMap<0> {
  using Type = TableBoundaryPlanner;
};

using DefaultPlanner = PlannerWithMap<kDefaultMapBytes>::Type;

}  // namespace whisker::planning

/// The default planner.
#pragma once

#include "firmware/planning/global/map_planner.hpp"

namespace whisker::planning {

/// Bytes of the largest map for which the target has room; 0: none. A build may define it.
#ifdef WHISKER_MAP_BYTES
constexpr int kRoomForMap = WHISKER_MAP_BYTES;
#else
constexpr int kRoomForMap = 16384;
#endif

/// Bytes of the default planner's map; 0: no map, the boundary planner. A build may define it.
#ifdef WHISKER_DEFAULT_MAP_BYTES
constexpr int kDefaultMapBytes = WHISKER_DEFAULT_MAP_BYTES;
#else
constexpr int kDefaultMapBytes = kRoomForMap >= kUsualMapBytes ? kUsualMapBytes : 0;
#endif
static_assert(kDefaultMapBytes <= kRoomForMap);

/// The planner with a map of so many bytes, or without a map.
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

/// The planner of the images that have but one: WHISKER_PLANNER_MAP says of how many bytes its map is.
#pragma once

#include "firmware/nav/map_planner.hpp"

namespace whisker::images {

template <int kMapBytes>
struct PlannerOf {
  using Type = nav::TableMap<kMapBytes>;
};
/// No map: the skirt planner.
template <>
struct PlannerOf<0> {
  using Type = nav::TableSkirt;
};

using Planner = PlannerOf<WHISKER_PLANNER_MAP>::Type;

}  // namespace whisker::images

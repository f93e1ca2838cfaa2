/// The planner of the images that have only one.
#pragma once

#include "firmware/planning/default_planner.hpp"

namespace whisker::images {

#ifdef WHISKER_PLANNER_MAP  // the bytes of its map, or 0
using Planner = planning::PlannerWithMap<WHISKER_PLANNER_MAP>::Type;
#else
using Planner = planning::DefaultPlanner;
#endif

}  // namespace whisker::images

/// The planner of the images that have but one.
#pragma once

#include "firmware/nav/default_planner.hpp"

namespace whisker::images {

#ifdef WHISKER_PLANNER_MAP  // the bytes of its map, or 0
using Planner = nav::PlannerWithMap<WHISKER_PLANNER_MAP>::Type;
#else
using Planner = nav::DefaultPlanner;
#endif

}  // namespace whisker::images

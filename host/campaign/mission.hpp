#pragma once

#include <atomic>
#include <functional>

#include "host/campaign/ordered.hpp"
#include "host/campaign/row.hpp"
#include "host/run/planners.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker::campaign {

constexpr double kWayRadius = 0.10;  ///< m: the shortest path is for a disc of this radius, unless said

/// Runs the scenario to a verdict and measures it; deterministic. Sets all of the row except the names of
/// robot and world. Throws Stopped soon after `stop` has become true. way_radius_m: of the disc whose
/// shortest path is measured. also: called with the record of each tick.
Row drive(const Scenario& scenario, PlannerKind planner, const std::atomic<bool>& stop,
          double way_radius_m = kWayRadius, const std::function<void(const TickRecord&)>& also = {});

}  // namespace whisker::campaign

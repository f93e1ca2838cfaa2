#pragma once

#include <atomic>

#include "host/campaign/ordered.hpp"
#include "host/campaign/row.hpp"
#include "host/run/planners.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker::campaign {

constexpr double kWayRadius = 0.10;  ///< m: the shortest way is one for a disc of this radius

/// Drives the scenario to a verdict and measures how; deterministic. Fills all of the row but
/// the names of robot and world. Throws Stopped soon after `stop` has become true.
Row drive(const Scenario& scenario, PlannerKind planner, const std::atomic<bool>& stop);

}  // namespace whisker::campaign

#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "host/harness/run/planners.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/lab/campaign/ordered.hpp"
#include "host/lab/campaign/row.hpp"
#include "host/lab/campaign/summary.hpp"

namespace whisker::campaign {

constexpr double kWayRadius = 0.10;  ///< m: the shortest path is for a disc of this radius, unless said

/// Runs the scenario to a verdict and measures it; deterministic. Sets all of the row except the names of
/// robot and world. Throws Stopped soon after `stop` has become true. way_radius_m: of the disc whose
/// shortest path is measured. also: called with the record of each tick.
Row drive(const Scenario& scenario, PlannerKind planner, const std::atomic<bool>& stop,
          double way_radius_m = kWayRadius, const std::function<void(const TickRecord&)>& also = {});

/// The reference of a body of kWayRadius with the omniscient reference at the range of this robot's beams,
/// see host/lab/scanner/reference_path.hpp. Sets only seed, verdict, path_m, shortest_m and planner
/// ("scanner").
Row scan(const Scenario& scenario);

/// As summary_words and summary_json, but only with the figures of these rows.
std::string scan_words(const Summary& summary);
std::string scan_json(const Summary& summary);

}  // namespace whisker::campaign

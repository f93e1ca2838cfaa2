#pragma once

#include <string>

#include "host/campaign/row.hpp"
#include "host/campaign/summary.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker::campaign {

/// The reference of a body of kWayRadius with the omniscient reference at the range of this robot's beams,
/// see host/scanner/reference_path.hpp. Sets only seed, verdict, path_m, shortest_m and planner ("scanner").
Row scan(const Scenario& scenario);

/// As summary_words and summary_json, but only with the figures of these rows.
std::string scan_words(const Summary& summary);
std::string scan_json(const Summary& summary);

}  // namespace whisker::campaign

/// What the core tells at a tick, in a record's terms.
#pragma once

#include <optional>

#include "firmware/robot.hpp"
#include "host/run/record.hpp"
#include "host/run/shown_guide.hpp"

namespace whisker {

/// All but the true pose and the true speeds. `guide`: null for a planner without a map.
TickRecord told(const Status& status, const ShownGuide* guide, const hal::RangeReadings& ranges, double t_s);

/// None: it is on its way, or has no goal.
std::optional<Verdict> verdict_of(planning::Outcome outcome);

}  // namespace whisker

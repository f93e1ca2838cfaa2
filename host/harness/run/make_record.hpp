/// Converts the core's output at a tick into a record.
#pragma once

#include <optional>

#include "firmware/robot.hpp"
#include "host/harness/run/record.hpp"
#include "host/harness/run/recording_guide.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker {

/// Everything except what add_truth() adds. `guide`: null for a planner without a map.
TickRecord make_record(const Status& status, const RecordingGuide* guide, const hal::RangeReadings& ranges,
                       double t_s);

/// The true pose and the true speeds.
void add_truth(const sim::Plant& plant, TickRecord& record);

/// None: the mission is running, or there is no goal.
std::optional<Verdict> verdict_of(planning::Outcome outcome);

}  // namespace whisker

/// A mission over a bus, and again from the frames of that bus.
#pragma once

#include <cstdint>
#include <string>

#include "host/harness/run/planners.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker::hunt {

/// Drives it in lockstep over a private bus, with the controller in a thread, and replays the recorded
/// frames. Empty: both gave the commands of this hash; otherwise "other_hash bus", "other_hash replay" or the
/// reason why there was no drive.
std::string differs_on_bus(const Scenario& scenario, PlannerKind planner, std::uint64_t hash);

}  // namespace whisker::hunt

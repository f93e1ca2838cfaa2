/// One run: the core drives the simulated robot until there is a verdict.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "firmware/health.hpp"
#include "firmware/perception/local_grid.hpp"
#include "host/harness/run/pilot.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/run/record.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker {

/// Everything observable at one tick; valid during the call only.
struct Moment {
  const TickRecord& record;
  const Health& health;
  const perception::LocalGrid* local_grid;  ///< passed to the planner
  const RecordingGuide* guide = nullptr;
};

struct RunOptions {
  PlannerKind planner = kDefaultPlanner;
  std::optional<std::uint64_t> seed;         ///< of the noise; overrides that of the scenario
  std::function<void(const Moment&)> watch;  ///< called at each tick, and once more at a contact
  /// Called about once per simulated second with the simulated time and the remaining distance.
  std::function<void(double time_s, double distance_m)> progress;
  MakePilot pilot = core_pilot;  ///< creates the pilot that drives
};

/// Deterministic: the same scenario and seed give the same hash on every machine. The loader must accept the
/// scenario.
RunResult run(const Scenario& scenario, const RunOptions& options = {});

}  // namespace whisker

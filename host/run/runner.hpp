/// One run: the core drives the simulated robot until there is a verdict.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "firmware/health.hpp"
#include "firmware/perception/local_grid.hpp"
#include "host/run/pilot.hpp"
#include "host/run/planners.hpp"
#include "host/run/record.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker {

/// All that can be seen of one tick; valid during the call only.
struct Moment {
  const TickRecord& record;
  const Health& health;
  const perception::LocalGrid* local_grid;  ///< the pilot's
  const ShownGuide* guide = nullptr;
};

struct RunOptions {
  PlannerKind planner = kDefaultPlanner;
  std::optional<std::uint64_t> seed;               ///< of the noise, instead of the scenario's
  std::vector<TickRecord>* records = nullptr;      ///< gets one record a tick, and one more at a contact
  std::function<void(const TickRecord&)> observe;  ///< called with each of these records as it arises
  std::function<void(const Moment&)> watch;        ///< the same, with what only a picture of the inside needs
  /// Called about once a simulated second with the simulated time and the distance left.
  std::function<void(double time_s, double distance_m)> progress;
  MakePilot pilot = core_pilot;  ///< what drives
};

/// Deterministic: the same scenario and seed give the same hash on every machine.
/// The scenario must be one that the loader accepts.
RunResult run(const Scenario& scenario, const RunOptions& options = {});

}  // namespace whisker

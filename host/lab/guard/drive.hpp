/// An operator drives the simulated robot, through the guard or without it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "firmware/guard.hpp"
#include "host/harness/run/event_player.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/lab/guard/guarded_body.hpp"
#include "host/lab/guard/operator.hpp"

namespace whisker::guard {

struct Options {
  bool guarded = true;     ///< false: the same commands go to the wheels, within their limits
  double time_s = 600;     ///< at most
  double vouched_m = 0;    ///< the operator vouches for this radius around the start
  bool until_goal = true;  ///< ends at the goal
  const fuzzy::Bilinear::Table* table = nullptr;  ///< of the assist; null: the core's own
  std::function<int()> gap_ms = nullptr;          ///< between two ticks; null: the control period
  std::function<void(const Moment&)> watch = nullptr;
  std::function<bool()> ended = nullptr;  ///< true: the operator has enough
};

enum class End { arrived, contact, fault, time, ended };  ///< ended: by Options::ended
const char* name(End end);

struct Result {
  End end = End::time;
  Fault fault = Fault::none;
  double time_s = 0;
  double path_m = 0;
  double min_clearance_m = 0;
  double final_distance_m = 0;  ///< from the goal
  std::uint64_t hash = 0;       ///< CommandHash over the commands of the guard; 0 without it
  double granted = 1;           ///< mean share of the asked forward speed, over the ticks that asked for one
  std::uint64_t ticks = 0;
  std::uint64_t stops = 0;           ///< times that the guard brought the asked forward speed to nothing
  std::optional<EventCount> events;  ///< none: the scenario has no events
  std::array<std::uint64_t, kGuardReasons> reasons{};  ///< ticks by reason
};

/// Deterministic.
Result drive(const Scenario& scenario, Operator& hand, const Options& options = {});

}  // namespace whisker::guard

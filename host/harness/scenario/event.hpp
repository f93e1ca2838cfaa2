/// What happens to the robot during a run. docs/scenario.md says what each kind does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/params.hpp"
#include "host/harness/sim/geometry.hpp"

namespace whisker {

struct Goal {
  sim::Vec2 at;
  double tolerance_m = 0.10;
};

enum class EventKind : std::uint8_t {
  goal,
  cancel,
  correct,
  place,
  reset,
  param,
  table,
  frames_lost,
  restart
};
constexpr int kEventKinds = 9;
/// As in a file.
const char* name(EventKind kind);

struct Event {
  double t_s = 0;
  EventKind kind = EventKind::goal;
  Goal goal;
  /// Of correct and place; none: the true one.
  std::optional<double> x_m, y_m, heading_deg;
  double sigma_m = 0, sigma_deg = 0;
  std::size_t param = 0;  ///< index in param_list()
  std::int64_t raw = 0;   ///< its value
  std::string file;       ///< rule base of a table; empty: the core's own table
  /// Of the file; null: it is not loaded.
  const fuzzy::Bilinear::Table* table = nullptr;
  double for_s = 0;
};

/// A parameter that is fixed while the robot runs: the base, or the simulated robot, depends on it.
bool is_fixed_in_a_run(const char* key);
/// Sets the parameter of the event. False: the parameters would not fit together any more; they are
/// unchanged.
bool apply_param(const Event& event, Params& params);

}  // namespace whisker

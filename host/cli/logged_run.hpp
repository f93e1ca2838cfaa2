#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "host/harness/hil/replay.hpp"
#include "host/harness/run/run_log.hpp"

namespace whisker::cli {

/// The last mission of a recorded bus, as the log of a run. A bus carries neither the world nor the true
/// pose: the world is empty, and the core's own estimate replaces the truth. Wheel speeds are computed from
/// the counts.
class LoggedRun {
 public:
  /// inside: of the log.
  explicit LoggedRun(std::string name, std::optional<PlannerKind> planner = std::nullopt, bool inside = true)
      : name_(std::move(name)), planner_(planner), inside_(inside) {}

  void begin(const can::Mission& mission, const Params& params);
  /// Returns the record of this step, valid until the next one.
  const TickRecord& step(const can::InputSet& set, const Status& status,
                         const perception::LocalGrid* local_grid, const RecordingGuide* guide);
  /// The bus, or the mission, ends here; verdict and remaining distance are the robot's own estimate.
  const RunLog& end();
  const RunLog& log() const { return *log_; }

 private:
  std::string name_;
  std::optional<PlannerKind> planner_;
  bool inside_;
  std::optional<RunLog> log_;
  Fault fault_ = Fault::none;
  planning::Outcome outcome_ = planning::Outcome::none;
  std::uint32_t first_tick_ = 0;
  hal::EncoderCounts counts_{};
};

}  // namespace whisker::cli

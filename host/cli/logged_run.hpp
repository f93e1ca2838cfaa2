#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host/harness/hil/replay.hpp"
#include "host/harness/run/record.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker::cli {

/// The last mission of a log, as a run. A log contains neither the world nor the true pose: the world is
/// empty, and the core's own estimate replaces the truth. Wheel speeds are computed from the counts.
class LoggedRun {
 public:
  explicit LoggedRun(std::string name) : name_(std::move(name)) {}

  void begin(const can::Mission& mission, const Params& params);
  /// The record of this step, valid until the next one.
  const TickRecord& step(const can::InputSet& set, const Status& status, const RecordingGuide* guide);

  const Scenario& scenario() const { return scenario_; }
  const std::vector<TickRecord>& records() const { return records_; }
  /// Up to the end of the log; verdict and remaining distance are the robot's own estimate.
  RunResult result() const;

 private:
  std::string name_;
  Scenario scenario_;
  std::vector<TickRecord> records_;
  Fault fault_ = Fault::none;
  planning::Outcome outcome_ = planning::Outcome::none;
  std::uint32_t first_tick_ = 0;
  hal::EncoderCounts counts_{};
};

}  // namespace whisker::cli

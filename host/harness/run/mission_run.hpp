/// One run, one tick at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/apps/command_hash.hpp"
#include "host/harness/run/pilot.hpp"
#include "host/harness/run/record.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker {

/// Call decide(), move(), decide(), move(), ... until one of them ends the run. All references must outlive
/// it; the plant stands at the scenario's start, and the pilot drives it.
class MissionRun {
 public:
  MissionRun(const Scenario& scenario, sim::Plant& plant, Pilot& pilot);

  /// The tick of the pilot. Ends with a verdict of the pilot, judged by the true position, or if no time is
  /// left for another tick.
  void decide();
  /// The period of the plant after it. Ends with a contact.
  void move();
  /// While true, only a contact and the time limit end the run: a verdict of the pilot is not the last one.
  void await_mission(bool to_come) { mission_to_come_ = to_come; }
  /// Continues after a verdict of the pilot, with another goal. A contact and a fault are final.
  void resume();

  const std::optional<Verdict>& verdict() const { return verdict_; }
  std::uint64_t ticks() const { return ticks_; }  ///< decided so far
  double time() const { return t_s_; }            ///< of the last tick, or of the contact record
  double next_time() const { return static_cast<double>(ticks_ * period_ms_) / 1000.0; }
  const Status& status() const { return *status_; }
  const perception::LocalGrid* local_grid() const { return pilot_->local_grid(); }
  const RecordingGuide* guide() const { return pilot_->guide(); }
  double distance_left() const;  ///< true, to the centre of the goal
  /// The same from the estimated position; none: unknown.
  std::optional<double> believed_distance() const;
  /// At the last tick, or at the contact.
  TickRecord record() const;
  /// So far; verdict and detail are valid only after the end.
  RunResult result() const;

 private:
  const Scenario* scenario_;
  sim::Plant* plant_;
  Pilot* pilot_;
  std::uint64_t period_ms_;
  std::uint64_t ticks_ = 0;
  double t_s_ = 0;
  const Status* status_ = nullptr;
  hal::RangeReadings ranges_{};
  CommandHash hash_;
  std::optional<Verdict> verdict_;
  bool mission_to_come_ = false;
  const char* detail_ = "";
};

}  // namespace whisker

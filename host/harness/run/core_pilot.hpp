#pragma once

#include "host/harness/run/braked_wheels.hpp"
#include "host/harness/run/fix_source.hpp"
#include "host/harness/run/pilot.hpp"
#include "host/harness/run/recording_planner.hpp"

namespace whisker {

/// Drives with the core in this process and any planner.
class CorePilot final : public Pilot {
 public:
  /// Scenario and plant must outlive it; the planner must be made with the scenario's robot.
  CorePilot(const Scenario& scenario, RecordedPlanner planner, sim::Plant& plant);
  const Status& tick(Time now) override;
  const perception::LocalGrid* local_grid() const override { return shown_.local_grid(); }
  std::optional<RangeTrust> ranges() const override { return robot_.status().health.ranges; }
  std::optional<localization::PoseSigma> sigma() const override {
    if (!robot_.status().sigma_known) return std::nullopt;
    return robot_.status().sigma;
  }
  const RecordingGuide* guide() const override { return planner_.guide; }
  /// Sets a new goal, during a mission or after it has ended.
  void set_goal(const planning::Goal& goal) { robot_.set_goal(goal); }
  Robot& robot() { return robot_; }
  const Status& status() const { return robot_.status(); }
  /// The wheels have braked without the robot.
  void note_braked() {
    wheels_.refuse();
    robot_.braked_elsewhere();
  }

 private:
  sim::Plant& plant_;
  FixSource fixes_;
  hal::SimBoard board_;
  BrakedWheels wheels_;
  RecordedPlanner planner_;
  RecordingPlanner shown_;
  Robot robot_;
};

/// One of the core's planners with this response table; null for a baseline.
/// Parameters and table must outlive the planner.
RecordedPlanner make_core_planner(PlannerKind kind, const Params& params, const fuzzy::Engine::Table& table);

}  // namespace whisker

#pragma once

#include <memory>
#include <optional>

#include "host/run/braked_wheels.hpp"
#include "host/run/fix_source.hpp"
#include "host/run/link_loss.hpp"
#include "host/run/pilot.hpp"
#include "host/run/recording_planner.hpp"

namespace whisker {

/// Drives with the core in this process and any planner.
class CorePilot final : public Pilot {
 public:
  /// Scenario and plant must outlive it; the planner must be made with the scenario's robot.
  CorePilot(const Scenario& scenario, RecordedPlanner planner, sim::Plant& plant);
  const Status& tick(Time now) override;
  bool play(const Event& event) override;
  bool hears() const override { return !loss_.lost(); }
  /// Planners of this kind for a robot that an event starts anew; without, such events are refused.
  void start_anew_with(PlannerKind kind) { kind_ = kind; }
  const perception::LocalGrid* local_grid() const override { return shown_->local_grid(); }
  std::optional<RangeTrust> ranges() const override { return robot_->status().health.ranges; }
  std::optional<localization::PoseSigma> sigma() const override {
    if (!robot_->status().sigma_known) return std::nullopt;
    return robot_->status().sigma;
  }
  const RecordingGuide* guide() const override { return planner_.guide; }
  /// Sets a new goal, during a mission or after it has ended.
  void set_goal(const planning::Goal& goal) { robot_->set_goal(goal); }

 private:
  void make_robot(const Params& params, const Pose& start);
  bool start_with(const planning::Goal& goal);
  bool aim(const planning::Goal& goal);
  bool choose_table(const Event& event);
  const Status& stay(bool brakes);
  void start_anew();
  void note_braked();

  sim::Plant& plant_;
  FixSource fixes_;
  hal::SimBoard board_;
  BrakedWheels wheels_;
  LinkLoss loss_;
  planning::Goal goal_;
  Params next_params_;    // of the next start
  bool changed_ = false;  // since the last one: the parameters, or the table
  std::optional<PlannerKind> kind_;
  std::optional<localization::UncertainPose> fix_;
  std::unique_ptr<Params> params_;
  RecordedPlanner planner_;
  std::optional<RecordingPlanner> shown_;
  std::optional<Robot> robot_;
  Status away_;  // without a controller
};

/// One of the core's planners with this response table; null for a baseline.
/// Parameters and table must outlive the planner.
RecordedPlanner make_core_planner(PlannerKind kind, const Params& params, const fuzzy::Engine::Table& table);

}  // namespace whisker

#pragma once

#include <memory>
#include <optional>

#include "firmware/apps/can/remote_robot.hpp"
#include "host/harness/hil/host_rules.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/run/recording_planner.hpp"

namespace whisker::hil {

/// Planners of one kind, for a controller on this computer.
class HostPlanners final : public can_app::PlannerMaker {
 public:
  /// rules: has the table of each new planner, and must outlive it; null: the kind has it.
  explicit HostPlanners(PlannerKind kind, const HostRules* rules = nullptr) : kind_(kind), rules_(rules) {}
  planning::Planner& make(const Params& params) noexcept override {
    planner_ = make_recorded_planner(rules_ != nullptr ? rules_->kind() : kind_, params);
    return *planner_.planner;
  }
  /// Global planner of the planner made last; null without a map.
  const RecordingGuide* guide() const { return planner_.guide; }

 private:
  PlannerKind kind_;
  const HostRules* rules_;
  RecordedPlanner planner_;
};

/// The same planners; the view of the last one is recorded.
class RecordingPlanners final : public can_app::PlannerMaker {
 public:
  explicit RecordingPlanners(PlannerKind kind, const HostRules* rules = nullptr) : planners_(kind, rules) {}
  planning::Planner& make(const Params& params) noexcept override {
    return shown_.emplace(planners_.make(params));
  }
  const perception::LocalGrid* local_grid() const { return shown_ ? shown_->local_grid() : nullptr; }
  const RecordingGuide* guide() const { return planners_.guide(); }

 private:
  HostPlanners planners_;
  std::optional<RecordingPlanner> shown_;
};

}  // namespace whisker::hil

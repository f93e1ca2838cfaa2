#pragma once

#include <memory>

#include "firmware/apps/can/remote_robot.hpp"
#include "host/run/planners.hpp"

namespace whisker::hil {

/// Planners of one kind, for a controller on this computer.
class HostPlanners final : public can_app::PlannerMaker {
 public:
  explicit HostPlanners(PlannerKind kind) : kind_(kind) {}
  planning::Planner& make(const Params& params) noexcept override {
    planner_ = make_recorded_planner(kind_, params);
    return *planner_.planner;
  }
  /// Global planner of the planner made last; null without a map.
  const RecordingGuide* guide() const { return planner_.guide; }

 private:
  PlannerKind kind_;
  RecordedPlanner planner_;
};

}  // namespace whisker::hil

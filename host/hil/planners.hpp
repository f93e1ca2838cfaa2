#pragma once

#include <memory>

#include "hal/can_remote/pilot.hpp"
#include "host/run/planners.hpp"

namespace whisker::hil {

/// Planners of one kind, for a controller on this computer.
class HostPlanners final : public can_remote::PlannerMaker {
 public:
  explicit HostPlanners(PlannerKind kind) : kind_(kind) {}
  nav::Planner& make(const Params& params) noexcept override {
    planner_ = make_planner(kind_, params);
    return *planner_;
  }

 private:
  PlannerKind kind_;
  std::shared_ptr<nav::Planner> planner_;
};

}  // namespace whisker::hil

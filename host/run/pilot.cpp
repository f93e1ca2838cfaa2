#include "host/run/pilot.hpp"

#include "hal/sim/sim_board.hpp"
#include "host/run/spec.hpp"

namespace whisker {
namespace {

/// Passes everything on, and remembers which ground it was shown.
class Shown final : public nav::Planner {
 public:
  explicit Shown(nav::Planner& planner) : planner_(planner) {}
  void set_goal(const nav::Goal& goal) noexcept override { planner_.set_goal(goal); }
  void cancel() noexcept override { planner_.cancel(); }
  nav::Decision step(const nav::View& view) noexcept override {
    patch_ = view.patch;
    return planner_.step(view);
  }
  const ground::Patch* patch() const { return patch_; }

 private:
  nav::Planner& planner_;
  const ground::Patch* patch_ = nullptr;
};

class CorePilot final : public Pilot {
 public:
  CorePilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant)
      : board_(plant),
        planner_(make_planner(planner, scenario.robot)),
        shown_(*planner_),
        robot_(board_, board_, shown_, scenario.robot) {
    robot_.place(fixed_pose(scenario.start));
    robot_.set_goal(fixed_goal(scenario.goal));
  }
  const Status& tick(Time now) override { return robot_.tick(now); }
  const ground::Patch* patch() const override { return shown_.patch(); }

 private:
  hal::SimBoard board_;
  std::shared_ptr<nav::Planner> planner_;
  Shown shown_;
  Robot robot_;
};

}  // namespace

std::unique_ptr<Pilot> core_pilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant) {
  return std::make_unique<CorePilot>(scenario, planner, plant);
}

nav::Goal fixed_goal(const Goal& goal) {
  return {fixed_pose({goal.at, 0}).at, fixed_pose({{goal.tolerance_m, 0}, 0}).at.x};
}

}  // namespace whisker

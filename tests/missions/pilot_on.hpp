/// The core on a board of the test.
#pragma once

#include <memory>

#include "firmware/robot.hpp"
#include "host/harness/run/pilot.hpp"
#include "host/harness/run/spec.hpp"

namespace whisker::test {

/// `Board`: a class that is constructed with a plant and provides sensors and wheels.
template <class Board>
class PilotOn : public Pilot {
 public:
  PilotOn(const Scenario& scenario, PlannerKind kind, sim::Plant& plant)
      : board_(plant),
        planner_(make_planner(kind, scenario.robot)),
        robot_(board_, board_, *planner_, scenario.robot) {
    robot_.place(fixed_pose(scenario.start));
    robot_.set_goal(fixed_goal(scenario.goal));
  }
  const Status& tick(Time now) override { return robot_.tick(now); }

 protected:
  Robot& robot() { return robot_; }

 private:
  Board board_;
  std::shared_ptr<planning::Planner> planner_;
  Robot robot_;
};

}  // namespace whisker::test

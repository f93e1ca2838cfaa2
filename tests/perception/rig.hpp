/// The whole robot on the simulated plant, with access to its local grid.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/planner.hpp"
#include "firmware/robot.hpp"
#include "host/harness/run/recording_planner.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/plant.hpp"
#include "host/harness/sim/sim_board.hpp"

namespace whisker::test {

class Rig {
 public:
  /// The boundary planner, or another one, which must outlive the rig.
  explicit Rig(const Scenario& scenario, planning::Planner* planner = nullptr);
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// One tick of the robot and one period of the plant. False: the run has ended, by contact or by verdict.
  bool step();
  const Status& status() const { return robot_.status(); }
  const planning::View& view() const { return recording_.view(); }
  const perception::LocalGrid* local_grid() const { return recording_.local_grid(); }
  const sim::Plant& plant() const { return plant_; }
  const sim::WorldView& world() const { return world_.view(); }

 private:
  const Scenario scenario_;
  SimWorld world_;
  sim::Plant plant_;
  hal::SimBoard board_;
  std::shared_ptr<planning::Planner> own_;
  RecordingPlanner recording_;
  Robot robot_;
  std::uint32_t now_ms_ = 0;
};

}  // namespace whisker::test

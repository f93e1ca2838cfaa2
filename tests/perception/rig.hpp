/// The whole robot on the simulated plant, with a view into its local grid.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/planner.hpp"
#include "firmware/robot.hpp"
#include "host/run/sim_world.hpp"
#include "host/scenario/scenario.hpp"
#include "host/sim/plant.hpp"
#include "host/sim/sim_board.hpp"

namespace whisker::test {

/// Passes everything on, and keeps what the planner was shown.
class Spy final : public planning::Planner {
 public:
  explicit Spy(planning::Planner& planner) : planner_(planner) {}
  void set_goal(const planning::Goal& goal) noexcept override { planner_.set_goal(goal); }
  void move_goal(Vec at) noexcept override { planner_.move_goal(at); }
  void cancel() noexcept override { planner_.cancel(); }
  planning::Decision step(const planning::View& view) noexcept override {
    view_ = view;
    return planner_.step(view);
  }
  const planning::View& view() const { return view_; }
  const perception::LocalGrid* local_grid() const { return view_.local_grid; }

 private:
  planning::Planner& planner_;
  planning::View view_;
};

class Rig {
 public:
  /// The boundary planner, or another one, which must outlive the rig.
  explicit Rig(const Scenario& scenario, planning::Planner* planner = nullptr);
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// One tick of the robot and one period of the plant. False: the run is over, by contact or by verdict.
  bool step();
  const Status& status() const { return robot_.status(); }
  const planning::View& view() const { return spy_.view(); }
  const perception::LocalGrid* local_grid() const { return spy_.local_grid(); }
  const sim::Plant& plant() const { return plant_; }
  const sim::WorldView& world() const { return world_.view(); }

 private:
  const Scenario scenario_;
  SimWorld world_;
  sim::Plant plant_;
  hal::SimBoard board_;
  std::shared_ptr<planning::Planner> own_;
  Spy spy_;
  Robot robot_;
  std::uint32_t now_ms_ = 0;
};

}  // namespace whisker::test

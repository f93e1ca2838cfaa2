/// The whole robot on the simulated plant, with a view into its patch.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "firmware/ground/patch.hpp"
#include "firmware/nav/planner.hpp"
#include "firmware/robot.hpp"
#include "hal/sim/sim_board.hpp"
#include "host/run/sim_world.hpp"
#include "host/scenario/scenario.hpp"
#include "host/sim/plant.hpp"

namespace whisker::test {

/// Passes everything on, and keeps what the planner was shown.
class Spy final : public nav::Planner {
 public:
  explicit Spy(nav::Planner& planner) : planner_(planner) {}
  void set_goal(const nav::Goal& goal) noexcept override { planner_.set_goal(goal); }
  void move_goal(Vec at) noexcept override { planner_.move_goal(at); }
  void cancel() noexcept override { planner_.cancel(); }
  nav::Decision step(const nav::View& view) noexcept override {
    view_ = view;
    return planner_.step(view);
  }
  const nav::View& view() const { return view_; }
  const ground::Patch* patch() const { return view_.patch; }

 private:
  nav::Planner& planner_;
  nav::View view_;
};

class Rig {
 public:
  /// The skirt planner, or another one, which must outlive the rig.
  explicit Rig(const Scenario& scenario, nav::Planner* planner = nullptr);
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// One tick of the robot and one period of the plant. False: the run is over, by contact or by verdict.
  bool step();
  const Status& status() const { return robot_.status(); }
  const nav::View& view() const { return spy_.view(); }
  const ground::Patch* patch() const { return spy_.patch(); }
  const sim::Plant& plant() const { return plant_; }
  const sim::WorldView& world() const { return world_.view(); }

 private:
  const Scenario scenario_;
  SimWorld world_;
  sim::Plant plant_;
  hal::SimBoard board_;
  std::shared_ptr<nav::Planner> own_;
  Spy spy_;
  Robot robot_;
  std::uint32_t now_ms_ = 0;
};

}  // namespace whisker::test

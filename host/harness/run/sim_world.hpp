#pragma once

#include <vector>

#include "host/harness/scenario/scenario.hpp"
#include "host/harness/scenario/world.hpp"
#include "host/harness/sim/world.hpp"

namespace whisker {

/// Owns the obstacles of a scenario in the simulator's form. Not copyable, because the view points into it.
class SimWorld {
 public:
  explicit SimWorld(const Scenario& scenario);
  SimWorld(const SimWorld&) = delete;
  SimWorld& operator=(const SimWorld&) = delete;
  const sim::WorldView& view() const { return view_; }

 private:
  World world_;
  std::vector<sim::MovingDisc> movers_;
  sim::WorldView view_;
};

/// Copies obstacles and goal.
void adopt_world(Scenario& to, const Scenario& from);

}  // namespace whisker

/// DistBug. Source: I. Kamon, E. Rivlin, "Sensory-based motion planning with global proofs", IEEE
/// Transactions on Robotics and Automation 13 (6), 1997.
#pragma once

#include "host/baselines/walker.hpp"

namespace whisker::baselines {

/// Straight to the goal. At an obstacle it follows the boundary, to the side whose beam sees farther, and
/// remembers d_min, the least distance to the goal so far. It leaves where d - F <= d_min - step: d is the
/// distance to the goal, F the free range towards it. Back at the hit point: unreachable.
///
/// F is what a beam within 6 degrees of the goal's direction sees, less the body, or what the local grid
/// proves. d_min is kept over the boundaries: the paper's rule gives the same where F is exact.
class DistBug final : public Walker {
 public:
  explicit DistBug(const Params& params) noexcept : Walker(params) {}

 private:
  void begin(const planning::View& view) override;
  Angle course(const planning::View& view) const override;
  planning::Side hit(const planning::View& view) override;
  bool may_leave(const planning::View& view) override;
  bool can_tell_unreachable() const override { return true; }

  Length least_;  ///< d_min
};

}  // namespace whisker::baselines

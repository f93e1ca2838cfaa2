/// DistBug. Source: I. Kamon, E. Rivlin, "Sensory-based motion planning with global proofs", IEEE
/// Transactions on Robotics and Automation 13 (6), 1997.
#pragma once

#include "host/lab/baselines/leave_rule.hpp"

namespace whisker::baselines {

/// Drives straight to the goal. At an obstacle it follows the boundary, to the side whose beam measures more,
/// and stores d_min, the smallest distance to the goal so far. It leaves if d - F <= d_min - step: d is the
/// distance to the goal, F the free range towards it. Back at the hit point: unreachable.
///
/// F is the range of a beam within 6 degrees of the goal's direction, minus the body, or the free distance
/// in the local grid. d_min is kept over the boundaries: the paper's rule gives the same if F is exact.
class DistBug final : public LeaveRule {
 public:
  /// The parameters must outlive it.
  explicit DistBug(const Params& params) noexcept : params_(params) {}

  void begin(const planning::View& view, const planning::Target& target) override;
  Angle course(const planning::View& view, const planning::Target& target) const override;
  planning::Side hit(const planning::View& view, const planning::Target& target) override;
  bool may_leave(const planning::View& view, const planning::Target& target) override;

 private:
  const Params& params_;
  Length least_;  ///< d_min
};

}  // namespace whisker::baselines

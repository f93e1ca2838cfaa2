/// Deflection laws without the response table. The rest is the boundary planner, so the difference shows the
/// effect of the table.
#pragma once

#include "firmware/planning/boundary/boundary_planner.hpp"

namespace whisker::baselines {

/// No deflection: the course is the first candidate heading beside the goal's direction that the local grid
/// does not block (steps of 7.5 degrees to 75).
class NoDeflection final : public planning::HeadingDeflection {
 public:
  Angle deflect(const planning::View&, Angle, const Params&, planning::Decision&) noexcept override {
    return {};
  }
};

/// Repulsion, each beam's growing with 1 / range - 1 / kInfluence below kInfluence. A side beam pushes to the
/// other side; the front beam pushes to the side that sees farther. At most 45 degrees.
/// Source: O. Khatib, "Real-time obstacle avoidance for manipulators and mobile robots", International
/// Journal of Robotics Research 5 (1), 1986, with bearings for forces.
class RepulsionDeflection final : public planning::HeadingDeflection {
 public:
  static constexpr double kInfluence_m = 2.0;
  static constexpr double kSideGain_rad = 0.05;   ///< per 1/m
  static constexpr double kFrontGain_rad = 0.20;  ///< per 1/m

  Angle deflect(const planning::View& view, Angle course, const Params& params,
                planning::Decision& decision) noexcept override;
};

/// A boundary planner with one of these laws.
template <class Law>
struct DeflectedBoundaryPlanner {
  /// The parameters must outlive it.
  explicit DeflectedBoundaryPlanner(const Params& params) : planner(params, law) {}
  Law law;
  planning::BoundaryPlanner planner;
};

}  // namespace whisker::baselines

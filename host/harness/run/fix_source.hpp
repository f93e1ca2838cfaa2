#pragma once

#include <optional>

#include "firmware/localization/pose_fix.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/fixes.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker {

/// The fixes that the scenario's [noise] gives to the core.
class FixSource {
 public:
  explicit FixSource(const Scenario& scenario);
  /// Call once per tick. None: no fix is due.
  std::optional<localization::UncertainPose> take(const sim::Plant& plant);

 private:
  sim::Fixes fixes_;
  localization::PoseSigma sigma_;
};

}  // namespace whisker

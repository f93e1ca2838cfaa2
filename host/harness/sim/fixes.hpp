/// A pose measured outside of the robot, as by a beacon or a camera.
#pragma once

#include <stdint.h>

#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/random.hpp"
#include "host/harness/sim/spec.hpp"

namespace whisker::sim {

class Fixes {
 public:
  Fixes(const NoiseSpec& noise, uint64_t seed);
  /// True once after each fix_every_m of path: the pose with the errors of the fix.
  bool take(const Pose& truth, double path_m, Pose& fix);

 private:
  double every_m_, sigma_m_, sigma_rad_;
  double last_m_ = 0;
  Random random_;
};

}  // namespace whisker::sim

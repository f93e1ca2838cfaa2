/// Readings of a beam in front of walls, by the simulator's cones.
#pragma once

#include <cstdint>
#include <vector>

#include "host/harness/sim/geometry.hpp"
#include "host/lab/calibration/sample.hpp"

namespace whisker::calibration {

struct Setting {
  Believed beam{30, 12.5, 0.05, 0.03, 0.02, 2.0};
  double skew_deg = 0;
  double incidence_deg = 50;
  double soft_deg = 0;  ///< up to which a reading's incidence limit is larger or smaller, at random
  std::vector<sim::Segment> walls{{{0.3, -20}, {0.3, 20}}};
  double from_deg = 0, to_deg = 380, step_deg = 0.5;  ///< headings of the body
  double sigma_m = 0;
  double dropout = 0;
  double phantom = 0;
  std::uint64_t seed = 1;
};

Samples swept(const Setting& setting);

}  // namespace whisker::calibration

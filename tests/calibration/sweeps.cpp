#include "tests/calibration/sweeps.hpp"

#include <cmath>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/sim/cone.hpp"
#include "host/harness/sim/random.hpp"

namespace whisker::calibration {

Samples swept(const Setting& s) {
  sim::Random random(s.seed, 1);
  Samples all;
  const double half = s.beam.half_cone_deg * kRadPerDeg;
  for (double deg = s.from_deg; deg <= s.to_deg; deg += s.step_deg) {
    const double limit = s.soft_deg * (2 * random.uniform() - 1);
    const double heading = deg * kRadPerDeg, axis = heading + (s.beam.axis_deg + s.skew_deg) * kRadPerDeg;
    const double c = std::cos(heading), d = std::sin(heading);
    const sim::Cone cone{{s.beam.x_m * c - s.beam.y_m * d, s.beam.x_m * d + s.beam.y_m * c},
                         {std::cos(axis), std::sin(axis)},
                         std::cos(half),
                         std::sin(half),
                         std::sin((s.incidence_deg + limit) * kRadPerDeg),
                         0};
    double metres = s.beam.max_range_m;
    for (const sim::Segment& wall : s.walls) metres = std::min(metres, sim::range(cone, wall));
    const bool lost = random.uniform() < s.dropout, phantom = random.uniform() < s.phantom;
    const double noise = s.sigma_m * random.normal(), ghost = 0.1 + 0.4 * random.uniform();
    Sample sample{heading, Reading::clear, 0};
    if (metres < s.beam.max_range_m) sample = {heading, Reading::echo, metres + noise};
    if (metres >= s.beam.max_range_m && phantom) sample = {heading, Reading::echo, ghost};
    if (lost) sample = {heading, Reading::lost, 0};
    all.push_back(sample);
  }
  return all;
}

}  // namespace whisker::calibration

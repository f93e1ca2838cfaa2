/// Draws that reach the ends of a range as often as its middle. The same on every machine.
#pragma once

#include "host/harness/sim/elementary.hpp"
#include "host/harness/sim/geometry.hpp"
#include "host/harness/worlds/random.hpp"

namespace whisker::hunt {

class Dice : public worlds::Random {
 public:
  using Random::Random;
  /// 0 < low <= high.
  double log_uniform(double low, double high) {
    return low * sim::exponential(uniform(0, sim::natural_log(high / low)));
  }
  sim::Vec2 direction() {
    const sim::SinCos turn = sim::sin_cos(uniform(0, 2 * sim::kPi));
    return {turn.cos, turn.sin};
  }
  /// A point in any direction, at a log-uniform distance.
  sim::Vec2 around(sim::Vec2 centre, double nearest, double farthest) {
    return centre + direction() * log_uniform(nearest, farthest);
  }
};

}  // namespace whisker::hunt

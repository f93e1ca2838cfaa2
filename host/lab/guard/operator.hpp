/// Whoever commands the velocity of the body.
#pragma once

#include "host/harness/sim/geometry.hpp"

namespace whisker::guard {

struct Twist {
  double forward_mps = 0;
  double turning_radps = 0;  ///< counter-clockwise positive
};

/// What an operator that watches the robot sees.
struct Sight {
  sim::Pose pose;  ///< true
  double t_s = 0;
};

class Operator {
 public:
  virtual ~Operator() = default;
  /// The next command.
  virtual Twist ask(const Sight& sight) = 0;
  /// Time until the one after it; infinite: there is none.
  virtual double pause_s() { return 0.02; }
  /// Time of the first command.
  virtual double first_s() { return 0; }
};

}  // namespace whisker::guard

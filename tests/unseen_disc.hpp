#pragma once

#include "host/harness/scenario/scenario.hpp"

namespace whisker::test {

/// A disc that no beam sees stands in the way of a slow robot with bump switches.
inline Scenario unseen_disc() {
  Scenario s;
  s.name = "unseen";
  s.goal.at = {2, 0.1};
  s.discs.push_back({{1, 0}, 0.15});
  s.sensor.soft = 1;
  s.sensor.soft_range_m = 0;
  s.robot.wheels.max_speed = 100_mm_per_s;
  s.robot.bumper.fitted = Fitted::yes;
  return s;
}

}  // namespace whisker::test

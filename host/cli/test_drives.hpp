/// Test drives that every fit robot completes.
#pragma once

#include <string>
#include <vector>

#include "host/run/planners.hpp"
#include "host/run/record.hpp"
#include "host/scenario/sensor.hpp"

namespace whisker::cli {

struct TestDrive {
  std::string world;  ///< "the empty world", "the corridor", "the field of discs"
  RunResult result;
};

/// With these sensors and no other noise, in worlds that scale with the body. The parameters must pass
/// check().
std::vector<TestDrive> test_drives(const Params& params, const Sensor& sensor, PlannerKind planner);

}  // namespace whisker::cli

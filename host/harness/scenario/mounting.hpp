/// What `whisker robot check` warns of although the parameters fit together.
#pragma once

#include <string>
#include <vector>

#include "firmware/params.hpp"
#include "host/harness/scenario/sensor.hpp"

namespace whisker {

struct MountingWarning {
  const char* kind;  ///< "invisible_walls", "near_reads_farther", "unseen_strip"
  std::string text;  ///< one line: what is wrong, and which change of one value would fit
};

/// Why the robot must not drive with sensors like this, a line for each fault: they see far less than its
/// parameters say. A little less is left to the robot to find out.
std::vector<std::string> contradictions(const Params& params, const Sensor& sensor);

/// The parameters must pass check().
std::vector<MountingWarning> mounting_warnings(const Params& params, const Sensor& sensor);

}  // namespace whisker

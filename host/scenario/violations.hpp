/// Which relations between a robot's parameters do not hold, and what would mend each.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware/params.hpp"

namespace whisker {

struct Violation {
  ParamFault fault;
  std::vector<std::size_t> keys;  ///< places in param_list() of the parameters that it is about
  std::vector<std::string> fits;  ///< "body_radius_m >= 0.07": each alone would do, all others as they are
};

/// All of them, in the order of check(). Every value must lie within its own range.
std::vector<Violation> violations(const Params& params);

}  // namespace whisker

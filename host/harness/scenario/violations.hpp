/// Violated relations between a robot's parameters, and changes that would satisfy each.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware/params.hpp"

namespace whisker {

struct Violation {
  ParamFault fault;
  std::vector<std::size_t> keys;  ///< indices in param_list() of the parameters in the relation
  std::vector<std::string> fits;  ///< "body_radius_m >= 0.07": one such change is sufficient
};

/// All of them, in the order of check(). Every value must lie within its own range.
std::vector<Violation> violations(const Params& params);

}  // namespace whisker

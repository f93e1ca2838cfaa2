/// Violated relations between a robot's parameters, and changes that would satisfy each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/params.hpp"

namespace whisker {

struct Violation {
  ParamFault fault;
  std::vector<std::size_t> keys;  ///< indices in param_list() of the parameters in the relation
  /// "body_radius_m >= 0.07": one such change is sufficient. Changes that need other hardware are listed only
  /// if no other change is sufficient.
  std::vector<std::string> fits;
  bool of_hardware = false;  ///< `fits` needs other hardware
  bool ray = false;          ///< it names a cone so narrow that it is one ray of a scan
};

/// A parameter's new value.
struct Change {
  std::size_t key;  ///< index in param_list()
  std::int64_t raw;
};

struct Violations {
  std::vector<Violation> all;  ///< in the order of check()
  /// Small changes of what an owner can set without other hardware (tolerances, steps, margins, waiting
  /// times, lower speeds and shorter ranges), with which all relations hold together. Empty: none was found,
  /// or they hold already.
  std::vector<Change> together;
};

/// Every value must lie within its own range.
Violations violations(const Params& params);

/// "drive_tolerance_m = 0.0052 and turn_tolerance_deg = 4.6"
std::string words(const Params& params, const std::vector<Change>& changes);

}  // namespace whisker

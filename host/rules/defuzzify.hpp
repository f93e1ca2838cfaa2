/// From an aggregated set to a number.
#pragma once

#include <vector>

#include "host/rules/aggregate.hpp"
#include "host/rules/rule_base.hpp"

namespace whisker::rules {

/// Every defuzzifier of a set. False, and `out` unchanged, if the set is empty.
bool defuzzify(const Canvas& canvas, Or aggregation, Defuzzifier defuzzifier,
               const std::vector<Activated>& activated, double& out);

}  // namespace whisker::rules

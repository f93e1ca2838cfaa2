/// The fuzzy stage as a textbook has it, in single precision: to compare its cost with. On a chip without
/// floating point, every operation is a call.
#pragma once

#include "firmware/fuzzy/variables.hpp"

namespace whisker::images {

struct FloatRules {
  float turn[fuzzy::kTerms][fuzzy::kTerms];
  float step[fuzzy::kTerms][fuzzy::kTerms];
};

/// SA and SD of crisp D and R.
struct FloatResponse {
  float turn;
  float step;
};

/// All 25 rules, those that do not fire left out of the sums.
FloatResponse infer(const FloatRules& rules, float distance, float bias) noexcept;

/// Of the same rules in integers.
FloatRules as_float(const fuzzy::RuleBase& rules) noexcept;

}  // namespace whisker::images

/// The textbook fuzzy inference in single precision, for a comparison of costs. On a chip without floating
/// point, every operation is a call.
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

/// Evaluates all 25 rules; rules that do not fire are left out of the sums.
FloatResponse infer(const FloatRules& rules, float distance, float bias) noexcept;

/// Converts the integer rules.
FloatRules as_float(const fuzzy::RuleBase& rules) noexcept;

}  // namespace whisker::images

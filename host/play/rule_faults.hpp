/// What an edit of the rule base breaks.
#pragma once

#include <cstdint>

#include "firmware/fuzzy/variables.hpp"

namespace whisker::play {

/// A set bit each; tests/fuzzy/rules_test.cpp asks all of them of the core's own rules.
enum RuleFault : std::uint32_t {
  kTurnNotMirrored = 1,     ///< a mirrored world gets another turn than the mirrored one
  kStepNotMirrored = 2,     ///< or another step
  kTurnsTowardsNearer = 4,  ///< a rule turns towards the side that is nearer
  kTurnsLessNear = 8,       ///< a rule turns less than the one for the same sides and more distance
  kStepsLongerNear = 16,    ///< a rule's step is longer than that
};
std::uint32_t rule_faults(const fuzzy::RuleBase& rules);

/// True where one of the faults involves this rule.
bool rule_at_fault(const fuzzy::RuleBase& rules, int d, int r);

}  // namespace whisker::play

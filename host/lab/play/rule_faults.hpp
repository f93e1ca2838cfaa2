/// Checks of an edited rule base.
#pragma once

#include <cstdint>

#include "firmware/fuzzy/variables.hpp"

namespace whisker::play {

/// One bit each; tests/fuzzy/rules_test.cpp applies all checks to the core's own rules.
enum RuleFault : std::uint32_t {
  kTurnNotMirrored = 1,     ///< the turn of a mirrored world is not the mirrored turn
  kStepNotMirrored = 2,     ///< nor is the step the same
  kTurnsTowardsNearer = 4,  ///< a rule turns towards the nearer side
  kTurnsLessNear = 8,       ///< a rule turns less than the rule for the same sides and more distance
  kStepsLongerNear = 16,    ///< a rule's step is longer than that of this rule
};
std::uint32_t rule_faults(const fuzzy::RuleBase& rules);

/// True if one of the faults involves this rule.
bool rule_at_fault(const fuzzy::RuleBase& rules, int d, int r);

}  // namespace whisker::play

#include "host/play/rule_faults.hpp"

#include <gtest/gtest.h>

#include "firmware/fuzzy/rules.hpp"

namespace whisker::play {
namespace {

using fuzzy::kTerms;

TEST(RuleFaults, TheOwnRulesHaveNone) {
  EXPECT_EQ(rule_faults(fuzzy::kRules), 0U);
  for (int d = 0; d < kTerms; ++d)
    for (int r = 0; r < kTerms; ++r) EXPECT_FALSE(rule_at_fault(fuzzy::kRules, d, r));
}

TEST(RuleFaults, AChangeOfOneTurnBesideTheMiddleIsNotMirrored) {
  for (int d = 0; d < kTerms; ++d) {
    for (int r = 0; r < kTerms; ++r) {
      fuzzy::RuleBase rules = fuzzy::kRules;
      rules.turn[d][r] = Q14::from_raw(static_cast<std::int16_t>(rules.turn[d][r].raw() + 100));
      EXPECT_TRUE(rule_faults(rules) & kTurnNotMirrored) << d << ' ' << r;
      EXPECT_TRUE(rule_at_fault(rules, d, r)) << d << ' ' << r;
      EXPECT_TRUE(rule_at_fault(rules, d, kTerms - 1 - r)) << d << ' ' << r;
    }
  }
}

TEST(RuleFaults, AMirroredRuleBaseThatTurnsTheWrongWayIsUnsafe) {
  fuzzy::RuleBase rules = fuzzy::kRules;
  for (auto& row : rules.turn)
    for (Q14& turn : row) turn = -turn;
  EXPECT_EQ(rule_faults(rules), kTurnsTowardsNearer);
}

TEST(RuleFaults, TurningLessOrSteppingLongerNearIsUnsafe) {
  fuzzy::RuleBase rules = fuzzy::kRules;
  rules.turn[0][0] = Q14::ratio(1, 2);
  rules.turn[0][kTerms - 1] = Q14::ratio(-1, 2);
  EXPECT_EQ(rule_faults(rules), kTurnsLessNear);
  rules = fuzzy::kRules;
  rules.step[0][2] = fuzzy::step_terms::VB;
  EXPECT_EQ(rule_faults(rules), kStepsLongerNear);
  rules.step[0][1] = fuzzy::step_terms::VB;
  EXPECT_EQ(rule_faults(rules), kStepsLongerNear | kStepNotMirrored);
}

}  // namespace
}  // namespace whisker::play

// Rules as text.
#include <gtest/gtest.h>

#include <string>

#include "host/rules/read.hpp"
#include "host/rules/rule_text.hpp"

namespace whisker::rules {
namespace {

std::string words_of(const std::string& rule) {
  const RuleBase base = parse_rules(
      "Engine: e\nInputVariable: a\n  range: 0 1\n  term: x Ramp 0 1\n  term: y Ramp 1 0\n"
      "InputVariable: b\n  range: 0 1\n  term: z Ramp 0 1\n"
      "OutputVariable: c\n  range: 0 1\n  aggregation: Maximum\n  defuzzifier: Centroid 100\n"
      "  default: 0\n  term: u Ramp 0 1\n  term: v Ramp 1 0\n"
      "RuleBlock: r\n  conjunction: Minimum\n  disjunction: Maximum\n  implication: Minimum\n"
      "  activation: General\n  rule: " +
          rule + "\n",
      "t.fll");
  return words(base, base.rules[0]);
}

TEST(RuleWords, AreThoseOfTheRule) {
  for (const char* const rule : {
           "if a is x then c is u",
           "if a is not very x then c is u with 0.5",
           "if a is any and b is somewhat z then c is v",
           "if (a is x or a is y) and b is z then c is u",
           "if a is x and (b is z or a is y) then c is u",
           "if a is x or a is y or b is z then c is u",
       })
    EXPECT_EQ(words_of(rule), rule);
}

TEST(RuleWords, HaveParenthesesWhereOperatorsMix) {
  EXPECT_EQ(words_of("if a is x and b is z or a is y then c is u"),
            "if (a is x and b is z) or a is y then c is u");
}

}  // namespace
}  // namespace whisker::rules

// Random rule bases: the inference agrees with fuzzylite, and the printed bound of each table is attained.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "host/lab/rules/compile.hpp"
#include "host/lab/rules/read.hpp"
#include "host/lab/rules/rule_text.hpp"
#include "tests/effort.hpp"
#include "tests/rules/oracle.hpp"
#include "tests/rules/random_base.hpp"

namespace whisker::rules {
namespace {

constexpr std::uint64_t kFirstSeed = 1000;

/// The look-up of every representable input, by look_up() itself.
void check_bound(const Compiled& c) {
  const Domain& domain = c.surface.domain;
  for (std::size_t o = 0; o < c.errors.size(); ++o) {
    const OutputScale& scale = c.table.scales[o];
    double greatest = 0;
    std::size_t i = 0;
    const auto error_at = [&](std::int32_t a, std::int32_t b) {
      const std::int32_t raw[2] = {domain.parts[0].from + a,
                                   domain.parts.size() > 1 ? domain.parts[1].from + b : 0};
      return std::abs(scale.origin + look_up(c.table, o, raw) / scale.per_unit - c.surface.values[o][i]);
    };
    for (std::int32_t a = 0; a < domain.rows(); ++a)
      for (std::int32_t b = 0; b < domain.columns(); ++b, ++i) greatest = std::max(greatest, error_at(a, b));
    EXPECT_NEAR(c.errors[o].greatest, greatest, 1e-12 + 1e-12 * greatest);
    const std::int32_t row = c.errors[o].at[0] - domain.parts[0].from;
    const std::int32_t column = domain.parts.size() > 1 ? c.errors[o].at[1] - domain.parts[1].from : 0;
    i = static_cast<std::size_t>(row) * static_cast<std::size_t>(domain.columns()) +
        static_cast<std::size_t>(column);
    EXPECT_NEAR(error_at(row, column), greatest, 1e-12 + 1e-12 * greatest);
  }
}

TEST(RandomRuleBases, AgreeWithFuzzyliteAndKeepTheirBound) {
  const std::uint64_t count = test::effort(34, 10000);
  int answers = 0;
  int refused = 0;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::string text = test::random_fll(seed);
    const RuleBase base = parse_rules(text, "random.fll");
    const test::Agreement a = test::compare(text, "fll", base, 7, static_cast<unsigned>(seed));
    EXPECT_EQ(a.disagrees, "") << text;
    answers += a.points;
    Options options;
    options.fewest_steps = 24;
    options.demand.tolerance = 0.02;
    try {
      const Compiled c = compile(base, options);
      for (std::size_t o = 0; o < c.errors.size(); ++o)
        EXPECT_LE(c.errors[o].greatest,
                  0.02 * c.spans[o] + (c.spans[o] == 0 ? 1 / c.table.scales[o].per_unit : 0));
      check_bound(c);
    } catch (const InputError& error) {
      ++refused;
      ADD_FAILURE() << error.what() << "\n" << text;
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(answers, 4 * static_cast<int>(count));
  RecordProperty("answers", answers);
  std::printf("%d answers of %d rule bases, seeds from %d\n", answers, static_cast<int>(count),
              static_cast<int>(kFirstSeed));
}

// Rules as text.

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

// Random rule bases: the inference agrees with fuzzylite, and the printed bound of each table is attained.
#include <gtest/gtest.h>

#include <cmath>

#include "host/rules/compile.hpp"
#include "host/rules/read.hpp"
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

}  // namespace
}  // namespace whisker::rules

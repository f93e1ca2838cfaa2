// Parts of the core, each judged alone: silent where nothing is wrong. planted_test.py has what is wrong.
#include "host/lab/hunt/parts/parts.hpp"

#include <gtest/gtest.h>

#include <set>

#include "host/lab/hunt/draw.hpp"
#include "host/lab/hunt/trial.hpp"
#include "tests/effort.hpp"

namespace whisker::hunt {
namespace {

constexpr std::uint64_t kFirstOfParts = 700001;

TEST(Parts, AreSilentOnTheCore) {
  for (const Part& part : parts()) {
    for (std::uint64_t seed = kFirstOfParts; seed < kFirstOfParts + test::effort(15); ++seed) {
      EXPECT_EQ(judge_part(part.name, seed), "") << part.name << ' ' << seed;
    }
  }
}

TEST(Parts, TakeTurnsInThreeOfFourFreshCases) {
  std::set<std::string> names;
  std::uint64_t count = 0;
  for (std::uint64_t seed = 1; count < parts().size(); ++seed) {
    const Case c = draw_fresh(seed).c;
    EXPECT_EQ(driver(c) == "part", seed % 4 != 0) << seed;
    if (seed % 4 == 0) continue;
    names.insert(c.part);
    ++count;
  }
  EXPECT_EQ(names.size(), parts().size());
}

TEST(Parts, ComeBackFromTheirFile) {
  const Case c = draw_fresh(7).c;
  const Case again = parse_case(texts(c, "case"), "case");
  EXPECT_EQ(again.part, c.part);
  EXPECT_EQ(again.attacker, c.attacker);
  EXPECT_EQ(repeat_command(c, "case"), "whisker hunt --case case.toml");
}

TEST(Parts, AnUnknownOneSaysNothing) { EXPECT_EQ(judge_part("none", 1), ""); }

}  // namespace
}  // namespace whisker::hunt

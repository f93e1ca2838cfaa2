// The committed table and the figures in the documentation follow from the rules.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "host/tools/table_text.hpp"
#include "tests/fuzzy/inputs.hpp"

namespace whisker::fuzzy {
namespace {

std::string contents(const char* path) {
  std::ifstream file{std::string{WHISKER_SOURCE_DIR} + path, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

TEST(ResponseTable, IsByteForByteWhatTheRulesGenerate) {
  const std::string committed = contents("/firmware/fuzzy/response_table.hpp");
  ASSERT_FALSE(committed.empty());
  EXPECT_TRUE(committed == tools::response_table_text(kRules)) << "build the target generate_table";
}

TEST(ResponseTable, ChangesItsTextWithOneUnitOfOneRule) {
  RuleBase rules = kRules;
  rules.step[4][2] = Q14::from_raw(static_cast<std::int16_t>(rules.step[4][2].raw() + 1));
  EXPECT_FALSE(contents("/firmware/fuzzy/response_table.hpp") == tools::response_table_text(rules));
}

TEST(ResponseTable, ChangesItsResponseWithOneUnitOfAnyNode) {
  Bilinear::Table table = kResponseTable;
  const Bilinear bilinear{table};
  for (int d = 0; d < Bilinear::kDistanceNodes; ++d) {
    for (int r = 0; r < Bilinear::kBiasNodes; ++r) {
      const Inputs at =
          inputs(kDistanceLow + d * Bilinear::kDistanceSpacing, kBiasLow + r * Bilinear::kBiasSpacing);
      const Response before = bilinear(at);
      Bilinear::Node& node = table.node[d][r];
      ++node.turn;
      ASSERT_EQ(bilinear(at).turn.raw(), before.turn.raw() + 1) << d << ' ' << r;
      ASSERT_EQ(bilinear(at).step, before.step) << d << ' ' << r;
      --node.turn;
      --node.step;
      ASSERT_EQ(bilinear(at).turn, before.turn) << d << ' ' << r;
      ASSERT_EQ(bilinear(at).step.raw(), before.step.raw() - 1) << d << ' ' << r;
      ++node.step;
    }
  }
}

}  // namespace
}  // namespace whisker::fuzzy

#include "host/scenario/text.hpp"

#include <gtest/gtest.h>

namespace whisker {
namespace {

TEST(TomlNumber, IsTheShortestFloatThatReadsBack) {
  EXPECT_EQ(toml_number(0.1), "0.1");
  EXPECT_EQ(toml_number(4), "4.0");
  EXPECT_EQ(toml_number(-0.0), "-0.0");
  EXPECT_EQ(toml_number(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(toml_number(1e-7), "1e-07");
}

TEST(TomlString, EscapesWhatTomlForbids) {
  EXPECT_EQ(toml_string("a\"b\\c\nd\x7F"), R"("a\"b\\c\u000Ad\u007F")");
  EXPECT_EQ(toml_string("10 \xC2\xB5m"), "\"10 \xC2\xB5m\"");
}

TEST(NearestWord, ForgivesSlipsButDoesNotGuess) {
  const std::vector<std::string_view> known{"center", "radius_m", "seed"};
  EXPECT_EQ(nearest_word("centre", known), "center");
  EXPECT_EQ(nearest_word("radius", known), "radius_m");
  EXPECT_EQ(nearest_word("radius_mm", known), "radius_m");
  EXPECT_EQ(nearest_word("sed", known), "seed");
  EXPECT_EQ(nearest_word("weather", known), "");
  EXPECT_EQ(nearest_word("", known), "");
}

TEST(JoinOr, ReadsAsASentence) {
  EXPECT_EQ(join_or({"a"}), "a");
  EXPECT_EQ(join_or({"a", "b"}), "a or b");
  EXPECT_EQ(join_or({"a", "b", "c"}), "a, b or c");
}

}  // namespace
}  // namespace whisker

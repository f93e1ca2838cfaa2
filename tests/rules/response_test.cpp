#include "host/rules/response.hpp"

#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "firmware/fuzzy/digest.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "host/rules/compile.hpp"
#include "host/rules/read.hpp"
#include "host/scenario/error.hpp"

namespace whisker::rules {
namespace {

std::string thesis_text() {
  std::ifstream file(std::string(WHISKER_SOURCE_DIR) + "/host/rules/examples/thesis.toml");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string with(std::string text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), now);
}

Response of(const std::string& text, const ResponseNames& names = {}) {
  return response(parse_rules(text, "law.toml"), names);
}

std::string error_of(const std::string& text, const ResponseNames& names = {}) {
  try {
    of(text, names);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Response, TheThesisGivesTheCommittedTableByteForByte) {
  const Response r = of(thesis_text());
  EXPECT_EQ(std::memcmp(&r.table, &fuzzy::kResponseTable, sizeof r.table), 0);
  EXPECT_EQ(fuzzy::digest(r.table), fuzzy::digest(fuzzy::kResponseTable));
  EXPECT_TRUE(r.symmetric);
}

TEST(Response, TheErrorIsThatOfTheCompiledTable) {
  Options options;
  options.demand.nodes = {fuzzy::Bilinear::kDistanceNodes, fuzzy::Bilinear::kBiasNodes};
  const Compiled compiled = compile(parse_rules(thesis_text(), "law.toml"), options);
  const Response r = of(thesis_text());
  EXPECT_DOUBLE_EQ(r.turn_error, compiled.errors[0].greatest);
  EXPECT_DOUBLE_EQ(r.step_error, compiled.errors[1].greatest);
}

TEST(Response, OneChangedRuleBreaksSymmetryAndChangesTheDigest) {
  const Response r = of(with(thesis_text(), R"(["TLVB", "TLVB", "Z", "TRVB", "TRVB"])",
                             R"(["TLVB", "TLVB", "TLB", "TRVB", "TRVB"])"));
  EXPECT_FALSE(r.symmetric);
  EXPECT_NE(fuzzy::digest(r.table), fuzzy::digest(fuzzy::kResponseTable));
}

TEST(Response, OtherNamesGiveTheSameTable) {
  const std::string text =
      with(with(thesis_text(), "name = \"D\"", "name = \"front\""), "name = \"SA\"", "name = \"steer\"");
  EXPECT_EQ(error_of(text), "law.toml:1:1: no input 'D' to drive with; the file has front, R");
  const ResponseNames names = response_names({"D=front", "SA=steer"});
  EXPECT_EQ(fuzzy::digest(of(text, names).table), fuzzy::digest(fuzzy::kResponseTable));
}

TEST(Response, OutputsAreFoundInAnyOrder) {
  ResponseNames swapped;
  std::swap(swapped.turn, swapped.step);
  const Response r = of(thesis_text(), swapped);
  EXPECT_EQ(r.table.node[3][20].turn, fuzzy::kResponseTable.node[3][20].step);
  EXPECT_EQ(r.table.node[3][20].step, fuzzy::kResponseTable.node[3][20].turn);
}

TEST(Response, RefusesWhatTheCoreCannotAsk) {
  EXPECT_EQ(error_of(with(thesis_text(), "range = [0.0, 10.0]", "range = [0.0, 9.5]")),
            "law.toml:5:1: 'D' is from 0 to 9.5; to drive with it, it must cover 0 to 10");
  EXPECT_EQ(
      error_of(with(with(thesis_text(), "[\"TLVB\", 1.5]", "[\"TLVB\", 2.5]"), "raw_per_unit = 16384", "")),
      "law.toml:17:1: 'SA' reaches 2.5; to drive with it, it must stay from -2 to 2");
}

TEST(Response, RefusesTwoRolesForOneVariable) {
  EXPECT_THROW(of(thesis_text(), response_names({"R=D"})), std::invalid_argument);
  EXPECT_THROW(of(thesis_text(), response_names({"SD=SA"})), std::invalid_argument);
}

TEST(Response, RefusesNamesOfNothing) {
  for (const char* bad : {"", "D", "D=", "X=front", "=front"})
    EXPECT_THROW(response_names({bad}), std::invalid_argument) << bad;
}

}  // namespace
}  // namespace whisker::rules

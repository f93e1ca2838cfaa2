#include "host/lab/rules/mirrored_rules.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "firmware/fuzzy/digest.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/lab/rules/compile.hpp"
#include "host/lab/rules/read.hpp"
#include "host/lab/rules/response.hpp"

namespace whisker::rules {
namespace {

std::string text_of(const char* file) {
  std::ifstream in(std::string(WHISKER_SOURCE_DIR) + "/host/" + file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

MirroredRules read(const std::string& text) { return mirrored_rules(parse_rules(text, "law.toml")); }

std::string error_of(const std::string& old, const std::string& now) {
  std::string text = text_of("rules/examples/thesis.toml");
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  try {
    read(text.replace(at, old.size(), now));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(MirroredRules, TheCoresOwnGiveTheCommittedTableByteForByte) {
  const auto table = admitted(core_rules());
  ASSERT_TRUE(table);
  EXPECT_EQ(std::memcmp(&table->table, &fuzzy::kResponseTable, sizeof table->table), 0);
}

TEST(MirroredRules, ReadFromAFileTheyGiveItsTable) {
  for (const char* file :
       {"rules/examples/thesis.toml", "lab/rules/laws/straight.toml", "lab/rules/laws/sides.toml"}) {
    const std::string text = text_of(file);
    const Response own = response(parse_rules(text, "law.toml"), {});
    const Response again = response(parse_rules(to_toml(read(text), "again", ""), "again.toml"), {});
    EXPECT_EQ(fuzzy::digest(again.table), fuzzy::digest(own.table)) << file;
  }
}

TEST(MirroredRules, TheFileReadsAsAPicture) {
  const std::string text = to_toml(core_rules(), "thesis", "one\ntwo");
  EXPECT_EQ(text.rfind("# one\n# two\nname = \"thesis\"\n", 0), 0U);
  EXPECT_NE(text.find(R"(rules = [
  # R: RVB  RB      CE      LB      LVB       # D
  ["TLVB", "TLVB", "Z",    "TRVB", "TRVB"],   # VS
  ["TLVB", "TLB",  "Z",    "TRB",  "TRVB"],   # S
)"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(R"(terms = [["VS", 0.3], ["S", 0.6], ["M", 1], ["B", 1.4], ["VB", 1.7]])"),
            std::string::npos);
}

TEST(MirroredRules, RefusesWhatASearchCannotChange) {
  EXPECT_EQ(error_of("[\"RB\", -4.0]", "[\"RB\", -4.5]"),
            "law.toml:11:1: a search starts from terms of 'R' that mirror each other about 0");
  EXPECT_EQ(error_of("[\"TLB\", 0.75]", "[\"TLB\", 0.5]"),
            "law.toml:17:1: a search starts from terms of 'SA' that mirror each other about 0");
  EXPECT_EQ(error_of("[\"TLB\",  \"Z\",    \"Z\", \"Z\",    \"TRB\"]",
                     "[\"TLB\",  \"Z\",    \"Z\", \"Z\",    \"Z\"]"),
            "law.toml:25:4: a search starts from rules that are mirrored in R");
  EXPECT_EQ(error_of("\"Z\", \"TRVB\", \"TRVB\"]", "\"TLB\", \"TRVB\", \"TRVB\"]"),
            "law.toml:22:4: a search starts from rules that are mirrored in R");
  EXPECT_EQ(error_of("name = \"D\"", "name = \"front\""),
            "law.toml:5:1: a search starts from the inputs D and R, in this order");
  EXPECT_EQ(error_of("name = \"SD\"", "name = \"pace\""),
            "law.toml:17:1: a search starts from the outputs SA and SD");
  EXPECT_EQ(error_of("[\"VS\", 0.3]", "[\"XS\", 0.1], [\"VS\", 0.3]"),
            "law.toml:30:1: a search starts from five terms of 'SD', not 6");
  try {
    mirrored_rules(parse_rules(text_of("rules/examples/tip.fis"), "tip.fis"));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "tip.fis:1:1: a search starts from a rule file in TOML");
  }
}

void expect_in_order(const MirroredRules& rules) {
  for (std::size_t t = 1; t < kTerms; ++t) EXPECT_GE(rules.distance[t] - rules.distance[t - 1], kLeastGap);
  EXPECT_GE(rules.distance[0], 1);
  EXPECT_LE(rules.distance[4], 9);
  EXPECT_GE(rules.bias[0], kLeastGap);
  EXPECT_GE(rules.bias[1] - rules.bias[0], kLeastGap);
  EXPECT_LE(rules.bias[1], 7);
  EXPECT_GE(rules.turn[0], kLeastTurnGap);
  EXPECT_GE(rules.turn[1] - rules.turn[0], kLeastTurnGap);
  EXPECT_LE(rules.turn[1], kGreatestTurn);
  for (const auto& row : rules.turns)
    for (const int turn : row) EXPECT_TRUE(turn >= -2 && turn <= 2);
  for (const auto& row : rules.steps)
    for (const int step : row) EXPECT_TRUE(step >= 0 && step <= 4);
}

TEST(Mutation, EveryCandidateIsInOrderHoweverFarItWalks) {
  Mutation mutation(20261125, true);
  MirroredRules rules = core_rules();
  for (int i = 0; i < 5000; ++i) {
    rules = mutation(rules);
    expect_in_order(rules);
  }
}

TEST(Mutation, EveryAdmittedCandidateIsMirroredAndWithinTheTolerance) {
  Mutation mutation(1125, true);
  MirroredRules parent = core_rules();
  int admitted_ones = 0;
  for (int i = 0; i < 12; ++i) {
    const MirroredRules child = mutation(parent);
    const auto r = admitted(child);
    if (!r) continue;
    EXPECT_TRUE(r->symmetric);
    EXPECT_LE(r->turn_error, kMostLookUpError * 2 * child.turn[1]);
    EXPECT_LE(r->step_error, kMostLookUpError * (child.step[4] - child.step[0]));
    ++admitted_ones;
    parent = child;
  }
  EXPECT_GE(admitted_ones, 4);
}

TEST(Mutation, AdmitsNoTableWhoseLookUpErrsMore) {
  MirroredRules steep = core_rules();
  steep.distance = {1, 2, 3, 4, 9};
  steep.turns[1] = {-2, -2};
  EXPECT_FALSE(admitted(steep));
}

TEST(Mutation, EqualSeedsGiveEqualCandidatesAndOthersGiveOthers) {
  Mutation a(1, true), b(1, true), c(2, true);
  const std::string one = to_toml(a(core_rules()), "x", "");
  EXPECT_EQ(one, to_toml(b(core_rules()), "x", ""));
  EXPECT_NE(one, to_toml(c(core_rules()), "x", ""));
  EXPECT_NE(one, to_toml(core_rules(), "x", ""));
}

TEST(Mutation, LeavesStepsAloneUnlessAsked) {
  Mutation mutation(3, false);
  MirroredRules rules = core_rules();
  for (int i = 0; i < 1000; ++i) {
    rules = mutation(rules);
    EXPECT_EQ(rules.steps, core_rules().steps);
  }
  EXPECT_EQ(rules.step, core_rules().step);
  EXPECT_NE(rules.turns, core_rules().turns);
  EXPECT_NE(rules.distance, core_rules().distance);
  EXPECT_NE(rules.bias, core_rules().bias);
  EXPECT_NE(rules.turn, core_rules().turn);
}

TEST(Mutation, ACandidateCompilesAsAnyRuleBase) {
  Mutation mutation(4, true);
  MirroredRules rules = core_rules();
  for (int i = 0; i < 5; ++i) rules = mutation(rules);
  const Compiled compiled = compile(parse_rules(to_toml(rules, "candidate", ""), "candidate.toml"), {});
  for (std::size_t o = 0; o < 2; ++o) EXPECT_LE(compiled.errors[o].greatest, 0.01 * compiled.spans[o]);
}

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

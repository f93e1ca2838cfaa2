// The examples agree with fuzzylite, and errors name their place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "host/harness/scenario/reader.hpp"
#include "host/lab/rules/inference.hpp"
#include "host/lab/rules/read.hpp"
#include "host/lab/rules/rule_text.hpp"
#include "tests/rules/oracle.hpp"

namespace whisker::rules {
namespace {

std::string text_of(const std::string& example) {
  return read_file(std::string(WHISKER_SOURCE_DIR) + "/host/rules/examples/" + example);
}

TEST(Examples, AgreeWithFuzzylite) {
  for (const char* name : {"tip.fis", "pendulum.fll", "follower.fis"}) {
    SCOPED_TRACE(name);
    const std::string text = text_of(name);
    const test::Agreement a = test::compare(text, std::string(name).substr(std::string(name).rfind('.') + 1),
                                            parse_rules(text, name), 60, 11);
    EXPECT_EQ(a.disagrees, "");
    EXPECT_GE(a.points, 40);
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Fis, OctavesNamesOfOperatorsAreMatlabs) {
  const std::string tip = text_of("tip.fis");
  const auto answer = [&](const char* product, const char* sum) {
    std::string text = replaced(tip, "AndMethod='min'", std::string("AndMethod='") + product + "'");
    text = replaced(text, "OrMethod='max'", std::string("OrMethod='") + sum + "'");
    text = replaced(text, "ImpMethod='min'", std::string("ImpMethod='") + product + "'");
    text = replaced(text, "AggMethod='max'", std::string("AggMethod='") + sum + "'");
    return Inference(parse_rules(text, "tip.fis"))({6.5, 8}).front().value;
  };
  EXPECT_EQ(answer("algebraic_product", "algebraic_sum"), answer("prod", "probor"));
  EXPECT_NE(answer("prod", "probor"), answer("min", "max"));
}

void expect_error(const std::string& name, const std::string& text, const std::string& what) {
  try {
    parse_rules(text, name);
    ADD_FAILURE() << "accepted; expected " << what;
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), what);
  }
}

TEST(Errors, NameThePlaceInAFisFile) {
  const std::string tip = text_of("tip.fis");
  const auto error = [&](const char* from, const char* to, const char* what) {
    SCOPED_TRACE(to);
    expect_error("tip.fis", replaced(tip, from, to), std::string("tip.fis:") + what);
  };
  error("'trimf',[2 5 8]", "'trimf',[5 2 8]", "20:13: the corners must ascend");
  error("'trimf',[2 5 8]", "'trimf',[2 5]", "20:13: 'trimf' needs 3 parameters, but has 2");
  error("'trimf',[2 5 8]", "'trimg',[2 5 8]",
        "20:13: unknown membership function 'trimg'; did you mean 'trimf'?");
  error("'trimf',[2 5 8]", "'trimf',[2 x 8]", "20:23: 'x' is not a number");
  error("'trimf',[2 5 8]", "'constant',[2]", "20:13: 'constant' is for outputs only");
  error("Type='mamdani'", "Type='mamdanitype2'",
        "4:7: type 'mamdanitype2' cannot be compiled; only mamdani and sugeno");
  error("ImpMethod='min'", "ImpMethod='einstein'",
        "11:12: implication 'einstein' cannot be compiled; only min and prod");
  error("DefuzzMethod='centroid'", "DefuzzMethod='wtaver'", "13:15: 'wtaver' does not fit a mamdani system");
  error("1 0, 1 (1) : 1", "4 0, 1 (1) : 1", "39:1: 'service' has no term 4");
  error("1 0, 1 (1) : 1", "1.25 0, 1 (1) : 1",
        "39:1: this hedge cannot be compiled; only .05, .20, .30 and .40");
  error("1 0, 1 (1) : 1", "1 0, 1.20 (1) : 1", "39:6: a hedge in a conclusion cannot be compiled");
  error("1 0, 1 (1) : 1", "1, 1 (1) : 1", "39:1: the rule names 1 inputs, but the file has 2");
  error("1 0, 1 (1) : 1", "1 0, 1 (2) : 1", "39:9: a weight must be from 0 to 1");
  error("[Rules]", "[Rule]", "38:2: unknown section [Rule]");
}

TEST(Fis, HedgesByNumberArePowers) {
  const std::string text = replaced(text_of("tip.fis"), "1 0, 1 (1) : 1", "1.30 0, 1 (1) : 1");
  const std::vector<Hedge> hedges = parse_rules(text, "tip.fis").rules[0].antecedent[0].hedges;
  EXPECT_DOUBLE_EQ(hedged(0.5, hedges), 0.125);
}

TEST(Warnings, AreOfNumbersThatDifferFromTheFile) {
  const std::string tip = text_of("tip.fis");
  const RuleBase plain = parse_rules(tip, "tip.fis");
  EXPECT_THAT(plain.warnings, testing::IsEmpty());
  const auto warnings = [&](const char* from, const char* to) {
    const RuleBase base = parse_rules(replaced(tip, from, to), "tip.fis");
    EXPECT_EQ(Inference(base)({6.5, 8}).front().value, Inference(plain)({6.5, 8}).front().value) << to;
    return base.warnings;
  };
  const auto is = [](const char* text) { return testing::ElementsAre(std::string("tip.fis:") + text); };
  EXPECT_THAT(warnings("NumRules=4", "NumRules=5"),
              is("8:10: NumRules is 5, but the file has 4, and all are read"));
  EXPECT_THAT(warnings("NumMFs=3", "NumMFs=2"),
              is("18:8: NumMFs is 2, but the file has 3, and all are read"));
  EXPECT_THAT(warnings("'trimf',[2 5 8]", "'trimf',[2 5 8 9]"),
              is("20:27: 'trimf' has 3 parameters; those after them are not read"));
  EXPECT_THAT(warnings("'trimf',[2 5 8]", "'trimf',[2 5 8 0]"), testing::IsEmpty()) << "padded";
}

TEST(Errors, NameARangeThatIsMissing) {
  const std::string tip = text_of("tip.fis");
  expect_error("tip.fis", replaced(tip, "Range=[0 10]\n", ""), "tip.fis:16:7: 'service' has no range");
  expect_error("tip.fis", replaced(tip, "Range=[0 10]", "Range=[0 0]"),
               "tip.fis:16:7: 'service': the range must be finite and not empty");
  expect_error("p.fll", replaced(text_of("pendulum.fll"), "  range: -30 30\n", ""),
               "p.fll:3:16: 'angle' has no range");
}

TEST(Fll, ABinarySetMayPointToInfinity) {
  const std::string pendulum = text_of("pendulum.fll");
  for (const char* direction : {"inf", "-inf"}) {
    const std::string text =
        replaced(pendulum, "term: Z Triangle -10 0 10", std::string("term: Z Binary 5 ") + direction);
    EXPECT_EQ(parse_rules(text, "p.fll").inputs[0].terms[2].set(6), *direction == '-' ? 0 : 1) << direction;
  }
}

TEST(Errors, NameThePlaceInAFllFile) {
  const std::string pendulum = text_of("pendulum.fll");
  const auto error = [&](const char* from, const char* to, const char* what) {
    SCOPED_TRACE(to);
    expect_error("p.fll", replaced(pendulum, from, to), std::string("p.fll:") + what);
  };
  error("activation: General", "activation: Highest 2",
        "39:15: activation 'Highest 2' cannot be compiled; only General");
  error("disjunction: none", "disjunction: Maxmum",
        "37:16: unknown S-norm 'Maxmum'; did you mean 'Maximum'?");
  error("angle is NB and", "angel is NB and", "40:12: unknown input 'angel'; did you mean 'angle'?");
  error("angle is NB and", "angle is NB or", "40:9: the rule block has no disjunction");
  error("then force is NB", "then force is very NB", "40:53: a hedge in a conclusion cannot be compiled");
  error("then force is NB", "then force is", "40:52: the rule ends where a term is expected");
  error("angle is NB and rate is NB", "force is NB and rate is NB",
        "40:12: 'force' is an output; a rule cannot depend on it");
  error("range: -30 30", "range: -inf inf", "5:10: '-inf' must be finite");
  error("aggregation: Maximum", "aggregation: none", "21:17: 'force' has no aggregation");
  error("term: Z Triangle -10 0 10", "term: Z Function angle*2",
        "9:11: a function of text cannot be compiled");
}

TEST(Errors, NameThePlaceInAFclFile) {
  const std::string fan = text_of("fan.fcl");
  const auto error = [&](const char* from, const char* to, const char* what) {
    SCOPED_TRACE(to);
    expect_error("fan.fcl", replaced(fan, from, to), std::string("fan.fcl:") + what);
  };
  error("METHOD : COGS", "METHOD : COGX", "33:12: METHOD 'COGX' cannot be compiled");
  error("METHOD : COGS", "METHOD : COG",
        "29:8: 'off' of 'duty': a constant or linear term needs a weighted average or sum");
  error("(0, 0) (4, 1) (6, 1)", "(0, 0) (4, 2) (6, 1)", "16:27: a degree must be from 0 to 1");
  error("END_FUNCTION_BLOCK", "", "51:1: the file ends where a section or END_FUNCTION_BLOCK is expected");
  error("trend IS NOT rising", "trend IS NOT rissing",
        "41:46: 'trend' has no term 'rissing'; did you mean 'rising'?");
}

/// An FCL file of one input x and one output y, from 0 to 10 each.
std::string fcl(const std::string& head, const std::string& x, const std::string& y,
                const std::string& rules) {
  return "FUNCTION_BLOCK" + head + "\nVAR_INPUT x : REAL; END_VAR VAR_OUTPUT y : REAL; END_VAR\nFUZZIFY x " +
         x + " RANGE := (0 .. 10); END_FUZZIFY\nDEFUZZIFY y " + y +
         " RANGE := (0 .. 10); DEFAULT := 0; END_DEFUZZIFY\n" + rules + "\nEND_FUNCTION_BLOCK\n";
}
const std::string kFclX = "TERM lo := (0, 1) (10, 0); TERM hi := (0, 0) (10, 1);";
const std::string kFclY = "TERM off := 0; TERM on := 100; METHOD : COGS;";
const std::string kFclRules =
    "RULEBLOCK r AND : MIN; RULE 1 : IF x IS lo THEN y IS on; RULE 2 : IF x IS hi THEN y IS off; "
    "END_RULEBLOCK";
double fcl_answer(const std::string& text, double x) {
  return Inference(parse_rules(text, "f.fcl"))({x}).front().value;
}

TEST(Fcl, IsReadInEveryDialect) {
  const auto same = [&](const std::string& text) { EXPECT_NEAR(fcl_answer(text, 3), 70, 1e-9) << text; };
  same(fcl(" f", kFclX, kFclY, kFclRules));
  same(fcl("", kFclX, kFclY, kFclRules));
  same(fcl(" f", kFclX, replaced(kFclY, "COGS", "CoGs"), kFclRules));
  same(fcl(" f", kFclX, kFclY, replaced(kFclRules, "AND : MIN;", "AND : min; ACT : Prod; ACCU : max;")));
  same(fcl(" f", kFclX, kFclY, replaced(kFclRules, "AND : MIN;", "OR : asum;")));
  same(fcl(" f", kFclX, kFclY, replaced(kFclRules, "IF x IS lo THEN", "IF x IS lo\r\n    THEN\n")));
  same(fcl(" f", kFclX, kFclY, replaced(kFclRules, "IF x IS lo", "IF NOT (x IS hi OR x IS hi)")));
  same(fcl(" f", kFclX, kFclY, replaced(kFclRules, "IF x IS lo", "IF NOT NOT (NOT x IS hi)")));
}

TEST(Rules, MayHaveAByteOrderMarkAndCrlf) {
  for (const char* name : {"tip.fis", "pendulum.fll", "fan.fcl", "thesis.toml"}) {
    std::string text = text_of(name);
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
    const std::string file = testing::TempDir() + "whisker_crlf_" + name;
    std::ofstream(file, std::ios::binary) << "\xEF\xBB\xBF" << text;
    EXPECT_EQ(read_rules(file).rules.size(), parse_rules(text_of(name), name).rules.size()) << name;
    std::filesystem::remove(file);
  }
}

TEST(Fcl, NotOfAPartIsOneLessItsDegree) {
  const std::string text =
      fcl(" f", kFclX, kFclY, replaced(kFclRules, "IF x IS lo", "IF NOT (x IS lo AND x IS hi)"));
  const RuleBase base = parse_rules(text, "f.fcl");
  EXPECT_NEAR(fcl_answer(text, 3), 100 * 0.7 / (0.7 + 0.3), 1e-9);
  EXPECT_EQ(words(base, base.rules[0]), "if not (x is lo and x is hi) then y is on");
}

TEST(Fcl, HasTheShapesOfJFuzzyLogic) {
  const auto degree = [&](const std::string& shape, double x) {
    return parse_rules(fcl(" f", kFclX + " TERM t := " + shape + ";", kFclY, kFclRules), "f.fcl")
        .inputs[0]
        .terms[2]
        .set(x);
  };
  EXPECT_NEAR(degree("COSINE 2 5", 6), 0.5, 1e-12) << "half of the width, centre";
  EXPECT_EQ(degree("cosine 2 5", 7.5), 0);
  EXPECT_NEAR(degree("Cosine 2 5", 3.25), 0.5, 1e-12) << "fuzzylite's: centre, width";
  EXPECT_NEAR(degree("GAUSS2 4 1 6 2", 8), std::exp(-0.5), 1e-12);
  EXPECT_EQ(degree("GAUSS2 4 1 6 2", 5), 1);
  EXPECT_NEAR(degree("DSIGM 8 2 6 7", 2), 0.5, 1e-12);
  EXPECT_EQ(degree("TRIANGLE 1 2 3", 2), 1);
  expect_error(
      "f.fcl", fcl(" f", kFclX, "TERM off := SINGLETONS (1, 1);" + kFclY.substr(15), kFclRules),
      "f.fcl:4:25: SINGLETONS cannot be compiled; write one number, or points such as (0, 0) (1, 1)");
}

TEST(Fcl, HasNoRangeOfTermsInOnePlace) {
  std::string text = fcl(" f", "TERM lo := (4, 1); TERM hi := (4, 1);", kFclY, kFclRules);
  text = replaced(text, " RANGE := (0 .. 10)", "");
  expect_error("f.fcl", replaced(text, "; END_FUZZIFY", " END_FUZZIFY"),
               "f.fcl:2:11: 'x' has no RANGE, and its terms span none");
}

TEST(Conditions, ThatNestTooDeepAreRefusedAtTheirEnd) {
  expect_error(
      "f.fcl",
      fcl(" f", kFclX, kFclY, replaced(kFclRules, "IF x IS lo THEN y IS on", "IF " + std::string(18, '('))),
      "f.fcl:5:53: the condition is nested too deep");
}

TEST(Errors, NameThePlaceInATomlFile) {
  const std::string thesis = text_of("thesis.toml");
  const auto error = [&](const char* from, const char* to, const char* what) {
    SCOPED_TRACE(to);
    expect_error("t.toml", replaced(thesis, from, to), std::string("t.toml:") + what);
  };
  error("[\"S\", 3.0]", "[\"S\", 0.5]", "7:23: the centres of an input must ascend");
  error("\"TLVB\", \"TLVB\", \"Z\"", "\"TLVB\", \"TLVC\", \"Z\"", "22:12: 'SA' has no term 'TLVC'");
  error("[\"TLVB\", \"TLVB\", \"Z\", \"TRVB\", \"TRVB\"],", "",
        "20:9: 'rules' must have 5 rows, one for each term of 'D'");
  error("raw_per_unit = 128", "raw_per_units = 128",
        "8:1: unknown key 'raw_per_units' in [[input]] 1; did you mean 'raw_per_unit'?");
}

TEST(Errors, RefuseOtherFormats) {
  expect_error("rules.txt", "x", "rules.txt:1:1: the name of a rule file ends in .fis, .fll, .fcl or .toml");
}

}  // namespace
}  // namespace whisker::rules

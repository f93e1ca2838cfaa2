// The examples agree with fuzzylite, and errors name their place.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "host/harness/scenario/reader.hpp"
#include "host/lab/rules/read.hpp"
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
  error("NumRules=4", "NumRules=5", "8:10: the file has 4 rules, not 5");
  error("1 0, 1 (1) : 1", "4 0, 1 (1) : 1", "39:1: 'service' has no term 4");
  error("1 0, 1 (1) : 1", "1.30 0, 1 (1) : 1",
        "39:1: this hedge has no agreed meaning; only .05, .20 and .40");
  error("1 0, 1 (1) : 1", "1, 1 (1) : 1", "39:1: the rule names 1 inputs, but the file has 2");
  error("1 0, 1 (1) : 1", "1 0, 1 (2) : 1", "39:9: a weight must be from 0 to 1");
  error("[Rules]", "[Rule]", "38:2: unknown section [Rule]");
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

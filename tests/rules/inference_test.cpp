// Answers in closed form.
#include "host/lab/rules/inference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "host/harness/scenario/error.hpp"
#include "host/lab/rules/read.hpp"

namespace whisker::rules {
namespace {

/// One input x in [0, 1] whose only term has the degree x, and outputs in [0, 4].
std::string mamdani(const std::string& defuzzifier, const std::string& aggregation,
                    const std::string& implication, const std::string& sets, const std::string& rules) {
  return "[System]\nType='mamdani'\nAndMethod='min'\nOrMethod='max'\nImpMethod='" + implication +
         "'\nAggMethod='" + aggregation + "'\nDefuzzMethod='" + defuzzifier +
         "'\n[Input1]\nName='x'\nRange=[0 1]\nMF1='m':'linsmf',[0 1]\nMF2='one':'trapmf',[-1 -1 2 "
         "2]\n[Output1]\nName='y'\nRange=[0 4]\n" +
         sets + "[Rules]\n" + rules;
}

double at(const std::string& fis, double x) {
  const RuleBase base = parse_rules(fis, "t.fis");
  return Inference(base)({x})[0].value;
}

const std::string kTwo = "MF1='a':'trimf',[0 1 2]\nMF2='b':'trimf',[1 2 3]\n";

TEST(Inference, TakesTheCentroidOfACutTriangle) {
  const std::string one = mamdani("centroid", "max", "min", "MF1='a':'trimf',[0 0 3]\n", "1, 1 (1) : 1\n");
  // A right triangle cut at s: a trapezoid with parallel sides 3 and 3 (1 - s), height s.
  for (const double s : {0.01, 0.25, 0.7, 1.0}) {
    const double top = 3 * (1 - s);
    const double area = s * (3 + top) / 2;
    const double moment = s * top * top / 2 + (3 - top) * s / 2 * (top + (3 - top) / 3);
    EXPECT_NEAR(at(one, s), moment / area, 1e-12) << s;
  }
}

TEST(Inference, ScalesWithTheProduct) {
  const std::string one = mamdani("centroid", "max", "prod", "MF1='a':'trimf',[0 0 3]\n", "1, 1 (1) : 1\n");
  for (const double s : {1e-6, 0.3, 1.0}) EXPECT_NEAR(at(one, s), 1, 1e-9);
}

TEST(Inference, AddsSetsThatOverlap) {
  // Both at full strength. Sum: two triangles of area 1 at 1 and 2. Maximum: symmetric too, so shift one
  // weight.
  const std::string rules = "1, 1 (1) : 1\n2, 2 (1) : 1\n";
  for (const double s : {0.2, 0.9}) {
    const double cut = 2 * s - s * s;  // area of a triangle with base 2 cut at s
    EXPECT_NEAR(at(mamdani("centroid", "sum", "min", kTwo, rules), s), (cut * 1 + 1 * 2) / (cut + 1), 1e-12);
    EXPECT_NEAR(at(mamdani("centroid", "sum", "prod", kTwo, rules), s), (s * 1 + 1 * 2) / (s + 1), 1e-12);
    // probor takes away the product: s times the integral of (2 - y)(y - 1) over [1, 2], about 1.5.
    EXPECT_NEAR(at(mamdani("centroid", "probor", "prod", kTwo, rules), s),
                (s * 1 + 1 * 2 - s / 6 * 1.5) / (s + 1 - s / 6), 1e-12);
  }
}

TEST(Inference, IntegratesAGaussian) {
  const std::string one =
      mamdani("centroid", "max", "prod", "MF1='a':'gaussmf',[0.8 1.5]\n", "1, 1 (1) : 1\n");
  const double s2 = 0.8 * std::sqrt(2.0);
  const double area = 0.8 * std::sqrt(M_PI / 2) * (std::erf(2.5 / s2) - std::erf(-1.5 / s2));
  const double first = 0.8 * 0.8 * (std::exp(-1.5 * 1.5 / (s2 * s2)) - std::exp(-2.5 * 2.5 / (s2 * s2)));
  for (const double s : {1e-7, 0.5, 1.0}) EXPECT_NEAR(at(one, s), 1.5 + first / area, 1e-11);
}

TEST(Inference, KeepsItsAccuracyWhereEveryRuleIsWeak) {
  // Cut at s, the centroid of a symmetric set stays; of two sets of one width and strength, it is the middle.
  const std::string one = mamdani("centroid", "max", "min", "MF1='a':'gaussmf',[0.3 2]\n", "1, 1 (1) : 1\n");
  for (const double s : {1e-5, 1e-8}) EXPECT_NEAR(at(one, s), 2, 1e-9) << s;
}

TEST(Inference, HalvesTheArea) {
  const std::string one = mamdani("bisector", "max", "min", "MF1='a':'trimf',[0 0 3]\n", "2, 1 (1) : 1\n");
  EXPECT_NEAR(at(one, 1), 3 - 3 / std::sqrt(2.0), 1e-12);
}

TEST(Inference, FindsTheMaximaAsMatlabDoes) {
  const std::string sets = "MF1='a':'trapmf',[0 1 1.5 2]\nMF2='b':'trapmf',[2 2.5 3.5 4]\n";
  const std::string rules = "2, 1 (1) : 1\n2, 2 (1) : 1\n";
  EXPECT_NEAR(at(mamdani("mom", "max", "min", sets, rules), 1), (0.5 * 1.25 + 1 * 3) / 1.5, 1e-9);
  EXPECT_NEAR(at(mamdani("som", "max", "min", sets, rules), 1), 1, 1e-9);
  EXPECT_NEAR(at(mamdani("lom", "max", "min", sets, rules), 1), 3.5, 1e-9);
  // One rule alone, cut at a half.
  EXPECT_NEAR(at(mamdani("som", "max", "min", sets, "1, 1 (1) : 1\n"), 0.5), 0.5, 1e-9);
}

TEST(Inference, FindsTheMaximaOfWeakRules) {
  for (const char* method : {"mom", "som", "lom"}) {
    const std::string one = mamdani(method, "max", "prod", "MF1='a':'trimf',[0 3 4]\n", "1, 1 (1) : 1\n");
    for (const double s : {1e-15, 1e-11, 1e-9, 0.5}) EXPECT_NEAR(at(one, s), 3, 1e-9) << method << " " << s;
  }
}

TEST(Inference, NegatesAConclusion) {
  // The complement of a triangle over the whole range [0, 4]: area 4 - 1, moment 8 - 1.
  EXPECT_NEAR(at(mamdani("centroid", "max", "min", "MF1='a':'trimf',[0 1 2]\n", "2, -1 (1) : 1\n"), 1),
              7.0 / 3, 1e-12);
}

TEST(Inference, TakesPointsAloneAsSingletons) {
  const std::string points = "MF1='a':'trimf',[1 1 1]\nMF2='b':'trapmf',[3 3 3 3]\n";
  const std::string fis =
      mamdani("centroid", "max", "min", points, "1, 1 (1) : 1\n1, 1 (1) : 1\n2, 2 (1) : 1\n");
  for (const double s : {0.5, 1.0}) EXPECT_NEAR(at(fis, s), (s * 1 + 1 * 3) / (s + 1), 1e-12) << s;
  EXPECT_EQ(parse_rules(fis, "t.fis").warnings.size(), 1U);
}

TEST(Inference, RefusesOtherSetsWithoutArea) {
  const auto refused = [](const std::string& fis) {
    try {
      parse_rules(fis, "t.fis");
      return std::string();
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  const std::string mixed = "MF1='a':'trimf',[1 1 1]\nMF2='b':'trimf',[1 2 3]\n";
  EXPECT_EQ(refused(mamdani("centroid", "max", "min", mixed, "1, 1 (1) : 1\n")),
            "t.fis:16:6: 'a' of 'y' has no area from 0 to 4, so it changes no answer");
  EXPECT_EQ(refused(mamdani("centroid", "max", "min", mixed, "1, 2 (1) : 1\n")), "") << "not concluded";
  EXPECT_EQ(refused(mamdani("centroid", "max", "min", mixed, "1, -1 (1) : 1\n")), "") << "its complement has";
  EXPECT_NE(refused(mamdani("mom", "max", "min", "MF1='a':'trimf',[1 1 1]\n", "1, 1 (1) : 1\n")), "");
  EXPECT_NE(refused(mamdani("centroid", "max", "min", "MF1='a':'trimf',[5 6 7]\n", "1, 1 (1) : 1\n")), "")
      << "outside the range";
}

TEST(Inference, CountsEqualRulesWhereTheyCount) {
  // A second term with the same set makes two rules that are not equal, and answer the same.
  const std::string sets = kTwo + "MF3='c':'trimf',[0 1 2]\n";
  const std::string equal = "1, 1 (1) : 1\n1, 1 (1) : 1\n2, 2 (1) : 1\n";
  const std::string other = "1, 1 (1) : 1\n1, 3 (1) : 1\n2, 2 (1) : 1\n";
  for (const char* method : {"centroid", "bisector", "mom"}) {
    for (const char* sum : {"max", "sum", "probor", "bounded_sum"}) {
      for (const char* implication : {"min", "prod"}) {
        SCOPED_TRACE(std::string(method) + " " + sum + " " + implication);
        for (const double s : {0.2, 0.9})
          EXPECT_NEAR(at(mamdani(method, sum, implication, sets, equal), s),
                      at(mamdani(method, sum, implication, sets, other), s), 1e-9);
      }
    }
  }
  const RuleBase base = parse_rules(mamdani("centroid", "sum", "min", sets, equal), "t.fis");
  EXPECT_EQ(Inference(base).same_as(1), 0U) << "computed once";
  const std::string sugeno =
      "[System]\nType='sugeno'\nAndMethod='prod'\nOrMethod='probor'\nDefuzzMethod='wtaver'\n[Input1]\nName='"
      "x'\n"
      "Range=[0 1]\nMF1='m':'linsmf',[0 1]\nMF2='one':'trapmf',[-1 -1 2 2]\n[Output1]\nName='y'\nRange=[0 "
      "1]\n"
      "MF1='a':'constant',[1]\nMF2='b':'constant',[2]\n[Rules]\n";
  EXPECT_NEAR(at(sugeno + equal, 0.9), (2 * 0.9 * 1 + 1 * 2) / (2 * 0.9 + 1), 1e-12);
}

TEST(Inference, AnswersTheMiddleOfTheRangeIfNoRuleFires) {
  EXPECT_EQ(at(mamdani("centroid", "max", "min", kTwo, "1, 1 (1) : 1\n"), 0), 2);
}

TEST(Inference, AveragesTakagiSugenoOfOrderOne) {
  const std::string fis =
      "[System]\nType='sugeno'\nAndMethod='prod'\nOrMethod='probor'\nDefuzzMethod='wtaver'\n[Input1]\nName='"
      "x'\nRange=[0 1]\n"
      "MF1='m':'linsmf',[0 1]\n[Input2]\nName='z'\nRange=[0 1]\nMF1='m':'linsmf',[0 "
      "1]\n[Output1]\nName='y'\nRange=[0 1]\n"
      "MF1='a':'linear',[2 3 1]\nMF2='b':'constant',[5]\n[Rules]\n1 1, 1 (1) : 1\n1 -1, 2 (0.5) : 2\n";
  const double x = 0.3;
  const double z = 0.6;
  const double first = x * z;
  const double second = 0.5 * (x + (1 - z) - x * (1 - z));
  const RuleBase base = parse_rules(fis, "t.fis");
  EXPECT_NEAR(Inference(base)({x, z})[0].value, (first * (2 * x + 3 * z + 1) + second * 5) / (first + second),
              1e-14);
}

TEST(Inference, MergesSingletonsOfOneTermInFcl) {
  const std::string fcl =
      "FUNCTION_BLOCK f VAR_INPUT x : REAL; END_VAR VAR_OUTPUT y : REAL; END_VAR\n"
      "FUZZIFY x TERM a := (0, 0) (1, 1); TERM b := (0, 1) (1, 0); END_FUZZIFY\n"
      "DEFUZZIFY y TERM p := 0; TERM q := 10; METHOD : COGS; DEFAULT := 0; END_DEFUZZIFY\n"
      "RULEBLOCK r AND : MIN; ACCU : MAX; RULE 1 : IF x IS a THEN y IS q; RULE 2 : IF x IS a THEN y IS q;\n"
      "RULE 3 : IF x IS b THEN y IS p; END_RULEBLOCK END_FUNCTION_BLOCK\n";
  const RuleBase base = parse_rules(fcl, "t.fcl");
  EXPECT_NEAR(Inference(base)({0.4})[0].value, 4, 1e-14);
}

}  // namespace
}  // namespace whisker::rules

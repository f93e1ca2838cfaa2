// Tables: the bound, the grid, the symmetry, and the core's own table.
#include "host/lab/rules/compile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "firmware/fuzzy/response_table.hpp"
#include "host/lab/rules/findings.hpp"
#include "host/lab/rules/read.hpp"

namespace whisker::rules {
namespace {

std::string example(const std::string& name) {
  return std::string(WHISKER_SOURCE_DIR) + "/host/rules/examples/" + name;
}

/// A rule base in TOML with one input from 0 to 8 and these centres of both variables.
std::string line_of(const std::string& inputs, const std::string& outputs, const std::string& rules) {
  return "[[input]]\nname = \"x\"\nrange = [0.0, 8.0]\nterms = " + inputs +
         "\n[[output]]\nname = \"y\"\nterms = " + outputs + "\nrules = " + rules + "\n";
}

Compiled compiled(const std::string& toml, const Options& options = {}) {
  return compile(parse_rules(toml, "t.toml"), options);
}

std::vector<std::string> warnings(const Compiled& c) {
  std::vector<std::string> all;
  for (const Finding& f : findings(c)) all.push_back(f.text);
  return all;
}

TEST(Compile, MakesTheCoresOwnTableOfItsRules) {
  Options options;
  options.demand.nodes = {33, 57};
  const Compiled c = compile(read_rules(example("thesis.toml")), options);
  ASSERT_EQ(c.table.bytes(), sizeof fuzzy::kResponseTable);
  EXPECT_EQ(std::memcmp(c.table.nodes.data(), &fuzzy::kResponseTable, c.table.bytes()), 0);
  EXPECT_NEAR(c.errors[0].greatest, 0.0400, 0.0001);
  EXPECT_NEAR(c.errors[1].greatest, 0.0195, 0.0001);
  EXPECT_TRUE(c.table.scales[0].odd);
  EXPECT_FALSE(c.table.scales[1].odd);
}

TEST(Compile, LooksUpWhatTheCoreLooksUp) {
  Options options;
  options.demand.nodes = {33, 57};
  const Compiled c = compile(read_rules(example("thesis.toml")), options);
  const fuzzy::Bilinear core{fuzzy::kResponseTable};
  for (std::int32_t d = 0; d <= 1280; ++d) {
    for (std::int32_t r = -1024; r <= 1024; r += 3) {
      const std::int32_t raw[2] = {d, r};
      const fuzzy::Response there =
          core({Q7::from_raw(static_cast<std::int16_t>(d)), Q7::from_raw(static_cast<std::int16_t>(r))});
      ASSERT_EQ(look_up(c.table, 0, raw), there.turn.raw()) << d << ' ' << r;
      ASSERT_EQ(look_up(c.table, 1, raw), there.step.raw()) << d << ' ' << r;
    }
  }
}

TEST(Compile, NamesEveryRuleThatNeverFires) {
  const std::string fis =
      "[System]\nType='mamdani'\nAndMethod='min'\nOrMethod='max'\nImpMethod='min'\nAggMethod='max'\n"
      "DefuzzMethod='centroid'\n[Input1]\nName='x'\nRange=[0 1]\nMF1='m':'linsmf',[0 "
      "1]\nMF2='far':'trimf',[5 6 7]\n"
      "[Output1]\nName='y'\nRange=[0 4]\nMF1='a':'trimf',[0 1 2]\nMF2='b':'trimf',[1 2 3]\n[Rules]\n"
      "1, 1 (1) : 1\n2, 2 (1) : 1\n1, 1 (1) : 1\n2, 2 (1) : 1\n";
  EXPECT_EQ(compile(parse_rules(fis, "t.fis"), {}).never, (std::vector<std::size_t>{1, 3}));
}

TEST(Compile, NeedsTwoNodesWhereTheLawIsAStraightLine) {
  const Compiled c =
      compiled(line_of(R"([["a", 0.0], ["b", 8.0]])", R"([["p", 1.0], ["q", 3.0]])", R"(["p", "q"])"));
  EXPECT_EQ(c.table.axes[0].nodes(), 2);
  EXPECT_EQ(c.table.bytes(), 4U);
  EXPECT_LE(c.errors[0].greatest, 1 / c.table.scales[0].per_unit);
}

TEST(Compile, TakesTheSmallestGridWithinTheTolerance) {
  const std::string bend =
      line_of(R"([["a", 0.0], ["b", 3.0], ["c", 8.0]])", R"([["p", 0.0], ["q", 1.0]])", R"(["p", "q", "p"])");
  Options options;
  options.fewest_steps = 64;
  std::size_t last = 0;
  for (const double tolerance : {0.5, 0.1, 0.02, 0.004}) {
    options.demand = {tolerance, {}, {}};
    const Compiled c = compiled(bend, options);
    EXPECT_LE(c.errors[0].greatest, tolerance * c.spans[0]);
    EXPECT_GE(c.table.bytes(), last);
    last = c.table.bytes();
    if (c.table.axes[0].shift == kMostShifts) continue;
    Options coarser;
    coarser.fewest_steps = 64;
    coarser.demand.most_bytes = c.table.bytes() - 2;
    try {
      EXPECT_GT(compiled(bend, coarser).errors[0].greatest, tolerance * c.spans[0]);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("no table fits"));
    }
  }
}

TEST(Compile, TakesTheBestTableWithinTheBytes) {
  Options options;
  options.demand.most_bytes = 600;
  const Compiled c = compile(read_rules(example("tip.fis")), options);
  EXPECT_LE(c.table.bytes(), 600U);
  options.demand.most_bytes = 5000;
  EXPECT_LT(compile(read_rules(example("tip.fis")), options).errors[0].greatest, c.errors[0].greatest);
}

TEST(Compile, TakesAnOutputThatChangesOnlyByRoundingAsConstant) {
  const Compiled c = compiled(line_of(R"([["a", 0.0], ["b", 3.0], ["c", 8.0]])",
                                      R"([["p", 0.1], ["q", 0.7]])", R"(["p", "p", "p"])"));
  EXPECT_EQ(c.spans[0], 0);
  EXPECT_EQ(c.table.bytes(), 4U);
  EXPECT_LE(c.errors[0].greatest, 1 / c.table.scales[0].per_unit);
}

TEST(Compile, RefusesThreeFreeInputsButNotAFixedOne) {
  std::string fis = "[System]\nType='sugeno'\nAndMethod='prod'\nOrMethod='max'\nDefuzzMethod='wtaver'\n";
  for (const char* i : {"1", "2", "3"})
    fis += std::string("[Input") + i + "]\nName='x" + i +
           "'\nRange=[0 1]\nMF1='s':'smf',[0 1]\nMF2='z':'zmf',[0 1]\n";
  fis +=
      "[Output1]\nName='y'\nRange=[0 1]\nMF1='p':'constant',[0]\nMF2='q':'linear',[0 0 1 0]\n[Rules]\n1 1 1, "
      "1 (1) : 1\n2 2 2, 2 (1) : 2\n";
  const RuleBase base = parse_rules(fis, "three.fis");
  try {
    compile(base, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "three.fis:17:7: a table has at most two inputs; fix one of the 3 with --fix x3=VALUE");
  }
  Options options;
  options.fixed = {{2, 0.25}};
  const Compiled c = compile(base, options);
  EXPECT_EQ(c.table.axes.size(), 2U);
  const Inference inference(base);
  const std::int32_t raw[2] = {500, 300};
  const double x = c.surface.domain.parts[0].axis.value(500);
  const double y = c.surface.domain.parts[1].axis.value(300);
  const OutputScale& scale = c.table.scales[0];
  EXPECT_NEAR(scale.origin + look_up(c.table, 0, raw) / scale.per_unit, inference({x, y, 0.25})[0].value,
              0.01 * c.spans[0]);
}

TEST(Findings, NameRulesThatNeverFire) {
  const std::string fis =
      "[System]\nType='mamdani'\nAndMethod='min'\nOrMethod='max'\nImpMethod='min'\nAggMethod='max'"
      "\nDefuzzMethod='centroid'\n"
      "[Input1]\nName='x'\nRange=[0 10]\nMF1='a':'trimf',[-5 0 10]\nMF2='b':'trimf',[11 12 13]\n"
      "[Output1]\nName='y'\nRange=[0 1]\nMF1='p':'trimf',[0 0.2 0.4]\n[Rules]\n1, 1 (1) : 1\n2, 1 (1) : 1\n";
  const Compiled c = compile(parse_rules(fis, "never.fis"), {});
  ASSERT_EQ(c.never, std::vector<std::size_t>{1});
  EXPECT_THAT(warnings(c), testing::Contains("rule 2 (line 19) never fires"));
  // MATLAB's answer where no rule fires.
  ASSERT_EQ(c.gaps.size(), 1U);
  EXPECT_EQ(c.gaps[0].answer, 0.5);
  EXPECT_NEAR(c.gaps[0].share, 1 / c.surface.inputs, 1e-12);
  EXPECT_THAT(warnings(c), testing::Contains(testing::HasSubstr("no rule fires for 'y'")));
}

TEST(Findings, NameABrokenSymmetry) {
  const std::string picture = R"(["p", "q", "r"])";
  const auto law = [&](const char* outputs) {
    return line_of(R"([["a", 0.0], ["b", 4.0], ["c", 8.0]])", outputs, picture);
  };
  EXPECT_THAT(warnings(compiled(law(R"([["p", -1.0], ["q", 0.0], ["r", 1.0]])"))), testing::IsEmpty());
  const Compiled c = compiled(law(R"([["p", -1.0], ["q", 0.0], ["r", 1.01]])"));
  EXPECT_THAT(warnings(c),
              testing::ElementsAre(testing::StartsWith("'y' is nearly antisymmetric in 'x'; broken by 0.")));
}

TEST(Findings, NamePlacesThatFallThoughTheLawRises) {
  const Compiled c =
      compiled(line_of(R"([["a", 0.0], ["b", 2.0], ["c", 4.0], ["d", 8.0]])",
                       R"([["p", 0.0], ["q", 5.0], ["r", 4.8], ["s", 9.0]])", R"(["p", "q", "r", "s"])"));
  EXPECT_THAT(warnings(c), testing::Contains(testing::StartsWith(
                               "'y' rises with 'x', but falls by up to 2.22 % of the span, at x = 4")));
}

TEST(Findings, NameAJumpButNoSteepSlope) {
  const auto law = [](const char* defuzzifier, const char* mf) {
    return std::string(
               "[System]\nType='mamdani'\nAndMethod='min'\nOrMethod='max'\nImpMethod='min'\nAggMethod='max'"
               "\nDefuzzMethod='") +
           defuzzifier + "'\n[Input1]\nName='x'\nRange=[0 10]\nMF1='a':'trapmf',[-1 0 " + mf +
           "]\nMF2='b':'trapmf',[" + mf +
           " 10 11]\n[Output1]\nName='y'\nRange=[0 1]\nMF1='p':'trimf',[0 0.2 0.4]\nMF2='q':'trimf',[0.6 0.8 "
           "1]\n[Rules]\n1, 1 (1) : 1\n2, 2 (1) : 1\n";
  };
  const Compiled jump = compile(parse_rules(law("mom", "3 7"), "j.fis"), {});
  EXPECT_THAT(warnings(jump), testing::Contains(testing::StartsWith("'y' jumps by ")));
  const Compiled steep = compile(parse_rules(law("centroid", "4.999 5.001"), "s.fis"), {});
  EXPECT_GT(rounding_effect(steep, 0), 0.05 * steep.spans[0]);
  EXPECT_THAT(warnings(steep), testing::Not(testing::Contains(testing::StartsWith("'y' jumps by "))));
}

}  // namespace
}  // namespace whisker::rules

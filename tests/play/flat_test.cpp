#include "host/lab/play/flat.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/play/rule_faults.hpp"
#include "host/lab/play/table_of.hpp"

namespace whisker::play {
namespace {

using fuzzy::kTerms;

Scenario with_everything() {
  Scenario s = worlds::generate(worlds::Kind::rooms, {});
  s.walls = {{{0.5, 0.5}, {0.6, 0.75}, {0.5, 1}}};
  s.movers = {{{2, 0.1}, 0.05, {{2, 0.1}, {2, 0.4}}, 0.2}};
  s.noise = {0.01, 0.02, 0.03, 0.004, 0.5};
  s.seed = (std::uint64_t{1} << 53) - 1;
  return s;
}

TEST(Flat, EveryClassOfWorldsComesBack) {
  for (const worlds::Kind kind : worlds::kKinds) {
    const std::vector<double> list = flat(worlds::generate(kind, {}));
    const std::optional<Scenario> back = scenario_of(list);
    ASSERT_TRUE(back) << worlds::name(kind);
    EXPECT_EQ(flat(*back), list) << worlds::name(kind);
  }
}

TEST(Flat, AllPartsComeBack) {
  const Scenario s = with_everything();
  const std::optional<Scenario> back = scenario_of(flat(s));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->seed, s.seed);
  EXPECT_EQ(back->start.heading, s.start.heading);
  EXPECT_EQ(back->walls.front().size(), 3U);
  EXPECT_EQ(back->movers.front().speed_mps, 0.2);
  EXPECT_EQ(back->noise.heading_drift_deg_per_sqrt_m, 0.5);
  EXPECT_EQ(back->discs.size(), s.discs.size());
  EXPECT_EQ(flat(*back), flat(s));
}

TEST(Flat, EveryOtherLengthIsRefused) {
  std::vector<double> list = flat(with_everything());
  list.push_back(0);
  EXPECT_FALSE(scenario_of(list));
  list.pop_back();
  while (!list.empty()) {
    list.pop_back();
    EXPECT_FALSE(scenario_of(list)) << list.size();
  }
}

TEST(Flat, NoNumberMayBeNoneOrHuge) {
  const std::vector<double> good = flat(with_everything());
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300, 1e300}) {
    for (std::size_t i = 0; i < good.size(); ++i) {
      std::vector<double> list = good;
      list[i] = bad;
      EXPECT_FALSE(scenario_of(list)) << i << " is " << bad;
    }
  }
}

TEST(RuleFaults, TheOwnRulesHaveNone) {
  EXPECT_EQ(rule_faults(fuzzy::kRules), 0U);
  for (int d = 0; d < kTerms; ++d)
    for (int r = 0; r < kTerms; ++r) EXPECT_FALSE(rule_at_fault(fuzzy::kRules, d, r));
}

TEST(RuleFaults, AChangeOfOneTurnBesideTheMiddleIsNotMirrored) {
  for (int d = 0; d < kTerms; ++d) {
    for (int r = 0; r < kTerms; ++r) {
      fuzzy::RuleBase rules = fuzzy::kRules;
      rules.turn[d][r] = Q14::from_raw(static_cast<std::int16_t>(rules.turn[d][r].raw() + 100));
      EXPECT_TRUE(rule_faults(rules) & kTurnNotMirrored) << d << ' ' << r;
      EXPECT_TRUE(rule_at_fault(rules, d, r)) << d << ' ' << r;
      EXPECT_TRUE(rule_at_fault(rules, d, kTerms - 1 - r)) << d << ' ' << r;
    }
  }
}

TEST(RuleFaults, AMirroredRuleBaseThatTurnsTheWrongWayIsUnsafe) {
  fuzzy::RuleBase rules = fuzzy::kRules;
  for (auto& row : rules.turn)
    for (Q14& turn : row) turn = -turn;
  EXPECT_EQ(rule_faults(rules), kTurnsTowardsNearer);
}

TEST(RuleFaults, TurningLessOrSteppingLongerNearIsUnsafe) {
  fuzzy::RuleBase rules = fuzzy::kRules;
  rules.turn[0][0] = Q14::ratio(1, 2);
  rules.turn[0][kTerms - 1] = Q14::ratio(-1, 2);
  EXPECT_EQ(rule_faults(rules), kTurnsLessNear);
  rules = fuzzy::kRules;
  rules.step[0][2] = fuzzy::step_terms::VB;
  EXPECT_EQ(rule_faults(rules), kStepsLongerNear);
  rules.step[0][1] = fuzzy::step_terms::VB;
  EXPECT_EQ(rule_faults(rules), kStepsLongerNear | kStepNotMirrored);
}

std::vector<double> committed() {
  std::vector<double> list;
  for (const auto& row : fuzzy::kResponseTable.node)
    for (const fuzzy::Bilinear::Node& node : row)
      list.insert(list.end(), {double(node.turn), double(node.step)});
  return list;
}

TEST(TableOf, GivesTheNodesBack) {
  const auto table = table_of(committed());
  ASSERT_TRUE(table);
  EXPECT_EQ(std::memcmp(&*table, &fuzzy::kResponseTable, sizeof *table), 0);
}

TEST(TableOf, AnotherCountIsNone) {
  std::vector<double> list = committed();
  list.pop_back();
  EXPECT_FALSE(table_of(list));
  list.resize(list.size() + 2);
  EXPECT_FALSE(table_of(list));
  EXPECT_FALSE(table_of({}));
}

TEST(TableOf, WhatIsNoAnswerIsNone) {
  for (const double good : {-32767.0, 32767.0, -0.0}) {
    std::vector<double> list = committed();
    list.back() = good;
    EXPECT_TRUE(table_of(list)) << good;
  }
  for (const double bad : {-32768.0, 32768.0, 0.5, 1e300, double(INFINITY), double(NAN)}) {
    std::vector<double> list = committed();
    list[7] = bad;
    EXPECT_FALSE(table_of(list)) << bad;
  }
}

}  // namespace
}  // namespace whisker::play

// The look-up, the closed form and exact inference on all 2.6 million pairs of inputs.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/engine.hpp"
#include "firmware/fuzzy/exact.hpp"
#include "firmware/fuzzy/generate.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "tests/fuzzy/closed_form.hpp"
#include "tests/fuzzy/corners.hpp"
#include "tests/fuzzy/fuzzylite_engine.hpp"
#include "tests/fuzzy/inputs.hpp"

namespace whisker::fuzzy {
namespace {

// 1.5 % of the output ranges in use: SA covers 3, SD covers 0.3..1.7.
constexpr double kTurnBar = 0.015 * 3.0;
constexpr double kStepBar = 0.015 * 1.4;

struct Largest {
  int turn = 0;
  int step = 0;
};

template <class Engine>
Largest largest_errors(const Engine& engine, const char* name) {
  const Exact exact{kRules};
  Largest largest;
  for_every_input([&](Inputs in) {
    const Response a = engine(in);
    const Response b = exact(in);
    largest.turn = std::max(largest.turn, std::abs(a.turn.raw() - b.turn.raw()));
    largest.step = std::max(largest.step, std::abs(a.step.raw() - b.step.raw()));
  });
  std::printf("%s: max error SA %.5f, SD %.5f\n", name, largest.turn / double{Q14::kOne},
              largest.step / double{Q14::kOne});
  return largest;
}

TEST(Bilinear, StaysWithinOnePointFivePercentOfExactInferenceOnEveryInput) {
  const Largest largest = largest_errors(Bilinear{kResponseTable}, "bilinear");
  EXPECT_LE(largest.turn / double{Q14::kOne}, kTurnBar);
  EXPECT_LE(largest.step / double{Q14::kOne}, kStepBar);
}

TEST(ClosedForm, EqualsExactInferenceOnEveryInput) {
  const Largest largest = largest_errors(ClosedForm{kRules}, "closed form");
  EXPECT_EQ(largest.turn, 0);
  EXPECT_EQ(largest.step, 0);
}

template <class Engine>
int unmirrored_inputs(const Engine& engine) {
  int count = 0;
  for_every_input([&](Inputs in) {
    const Response here = engine(in);
    const Response there = engine({in.distance, -in.bias});
    count += here.turn.raw() != -there.turn.raw() || here.step.raw() != there.step.raw();
  });
  return count;
}

TEST(Bilinear, MirrorsExactlyOnEveryInput) { EXPECT_EQ(unmirrored_inputs(Bilinear{kResponseTable}), 0); }
TEST(ClosedForm, MirrorsExactlyOnEveryInput) { EXPECT_EQ(unmirrored_inputs(ClosedForm{kRules}), 0); }
TEST(Exact, MirrorsExactlyOnEveryInput) { EXPECT_EQ(unmirrored_inputs(Exact{kRules}), 0); }

template <class Engine>
int outside_their_corners(const typename Engine::Table& table) {
  const Engine engine{table};
  int count = 0;
  for_every_input([&](Inputs in) {
    const Response response = engine(in);
    count += !within(response, corners(table, response.cell));
  });
  return count;
}

TEST(Bilinear, StaysWithinTheCornersOfItsCellOnEveryInput) {
  EXPECT_EQ(outside_their_corners<Bilinear>(kResponseTable), 0);
}
TEST(ClosedForm, StaysWithinTheCornersOfItsRuleCellOnEveryInput) {
  EXPECT_EQ(outside_their_corners<ClosedForm>(kRules), 0);
}

TEST(Bilinear, NamesACellThatHoldsTheInputWithinTheNodes) {
  const Bilinear bilinear{kResponseTable};
  int strays = 0;
  for_every_input([&](Inputs in) {
    const Cell cell = bilinear(in).cell;
    const int d = std::clamp<int>(in.distance.raw(), kDistanceLow, kDistanceHigh) - kDistanceLow;
    const int r = std::clamp<int>(in.bias.raw(), kBiasLow, kBiasHigh) - kBiasLow;
    const int low_d = cell.distance * Bilinear::kDistanceSpacing;
    const int low_r = cell.bias * Bilinear::kBiasSpacing;
    strays += d < low_d || d > low_d + Bilinear::kDistanceSpacing || r < low_r ||
              r > low_r + Bilinear::kBiasSpacing || cell.distance + 1 >= Bilinear::kDistanceNodes ||
              cell.bias + 1 >= Bilinear::kBiasNodes;
  });
  EXPECT_EQ(strays, 0);
}

TEST(Bilinear, RoundsTiesOfTurnTowardZeroAndTiesOfStepUp) {
  const Inputs halfway = inputs(kDistanceLow + Bilinear::kDistanceSpacing / 2, kBiasLow);
  Bilinear::Table table{};
  const Bilinear bilinear{table};
  table.node[0][0] = {1, 1};
  EXPECT_EQ(bilinear(halfway).turn.raw(), 0);
  EXPECT_EQ(bilinear(halfway).step.raw(), 1);
  table.node[0][0] = {-1, -1};
  EXPECT_EQ(bilinear(halfway).turn.raw(), 0);
  EXPECT_EQ(bilinear(halfway).step.raw(), 0);
}

TEST(ClosedForm, NamesTheRuleCellThatExactInferenceNames) {
  const ClosedForm closed{kRules};
  const Exact exact{kRules};
  int different = 0;
  for_every_input([&](Inputs in) {
    const Cell a = closed(in).cell;
    const Cell b = exact(in).cell;
    different += a.distance != b.distance || a.bias != b.bias;
  });
  EXPECT_EQ(different, 0);
}

TEST(Engine, RunsOnItsDefaultTable) {
  const Engine engine{kDefaultTable};
  const Exact exact{kRules};
  for (int d = 0; d <= kDistanceMax; d += 7) {
    for (int r = -kBiasMax; r <= kBiasMax; r += 5) {
      const Response a = engine(inputs(d, r));
      const Response b = exact(inputs(d, r));
      ASSERT_LE(std::abs(a.turn.raw() - b.turn.raw()), kTurnBar * Q14::kOne) << d << ' ' << r;
      ASSERT_LE(std::abs(a.step.raw() - b.step.raw()), kStepBar * Q14::kOne) << d << ' ' << r;
    }
  }
}

// Compares the rule base with fuzzylite, an independent implementation.

// fuzzylite gets constants as raw units / 2^14, so that only our final rounding differs.
constexpr double kBound = 0.5 / Q14::kOne + 1e-9;

TEST(Exact, AgreesWithFuzzyliteOnADenseGrid) {
  const auto engine = fuzzylite_engine(kRules);
  std::string why;
  ASSERT_TRUE(engine->isReady(&why)) << why;
  const Exact exact{kRules};
  double largest = 0;
  int count = 0;
  for (int d = 0; d <= kDistanceMax; d += 5) {
    for (int r = -kBiasMax; r <= kBiasMax; r += 8) {
      engine->setInputValue("D", d / 128.0);
      engine->setInputValue("R", r / 128.0);
      engine->process();
      const Response response = exact(inputs(d, r));
      const double turn_error = response.turn.raw() / double{Q14::kOne} - engine->getOutputValue("SA");
      const double step_error = response.step.raw() / double{Q14::kOne} - engine->getOutputValue("SD");
      ASSERT_TRUE(std::isfinite(turn_error) && std::isfinite(step_error)) << d << ' ' << r;
      largest = std::max({largest, std::abs(turn_error), std::abs(step_error)});
      ++count;
    }
  }
  std::printf("fuzzylite: max difference %.7f on %d inputs\n", largest, count);
  EXPECT_LE(largest, kBound);
}

// Random rule bases on a random lattice of inputs. RC_PARAMS="seed=N" repeats a run.

// Bound of the look-up's error, over every input and every rule base, as a part of the spread of the cell's
// four answers; each of the three roundings adds half a unit.
constexpr double kErrorPerSpread = 0.0288;
constexpr double kRoundings = 1.5;

Q14 any_answer() { return Q14::from_raw(*rc::gen::arbitrary<std::int16_t>().as("raw Q14")); }

RuleBase any_rules() {
  RuleBase rules;
  for (auto* picture : {&rules.turn, &rules.step})
    for (auto& row : *picture)
      for (Q14& answer : row) answer = any_answer();
  return rules;
}

/// Calls f(inputs) on a lattice with random offsets; strides are coprime to node and centre spacings.
template <class F>
void on_a_lattice(F&& f) {
  const int first_d = *rc::gen::inRange(0, 13);
  const int first_r = *rc::gen::inRange(0, 11);
  for (int d = first_d; d <= kDistanceMax; d += 13)
    for (int r = first_r - kBiasMax; r <= kBiasMax; r += 11) f(inputs(d, r));
}

RC_GTEST_PROP(AnyRuleBase, ClosedFormEqualsExactInference, ()) {
  const RuleBase rules = any_rules();
  const ClosedForm closed{rules};
  const Exact exact{rules};
  on_a_lattice([&](Inputs in) {
    RC_ASSERT(closed(in).turn.raw() == exact(in).turn.raw());
    RC_ASSERT(closed(in).step.raw() == exact(in).step.raw());
  });
}

RC_GTEST_PROP(AnyRuleBase, ErrorOfTheLookUpIsAtMostAFixedPartOfTheCellsSpread, ()) {
  const RuleBase rules = any_rules();
  const auto table = std::make_unique<Bilinear::Table>();
  generate<Bilinear>(rules, *table);
  const Bilinear bilinear{*table};
  const Exact exact{rules};
  on_a_lattice([&](Inputs in) {
    const Response a = bilinear(in);
    const Response b = exact(in);
    const Corners rule_corners = corners(rules, b.cell);
    RC_ASSERT(std::abs(a.turn.raw() - b.turn.raw()) <=
              kErrorPerSpread * spread(rule_corners.turn) + kRoundings);
    RC_ASSERT(std::abs(a.step.raw() - b.step.raw()) <=
              kErrorPerSpread * spread(rule_corners.step) + kRoundings);
  });
}

RC_GTEST_PROP(AnyRuleBase, EveryEngineStaysWithinTheCornersOfItsCell, ()) {
  const RuleBase rules = any_rules();
  const auto table = std::make_unique<Bilinear::Table>();
  generate<Bilinear>(rules, *table);
  const Bilinear bilinear{*table};
  const ClosedForm closed{rules};
  on_a_lattice([&](Inputs in) {
    const Response a = bilinear(in);
    const Response b = closed(in);
    RC_ASSERT(within(a, corners(*table, a.cell)));
    RC_ASSERT(within(b, corners(rules, b.cell)));
  });
}

RC_GTEST_PROP(AnyRuleBase, MirroredRulesGiveTheMirroredResponse, ()) {
  RuleBase rules = any_rules();
  RuleBase mirrored;
  for (int i = 0; i < kTerms; ++i) {
    for (int j = 0; j < kTerms; ++j) {
      rules.turn[i][j] = -(-rules.turn[i][j]);  // -32768 has no negative counterpart
      mirrored.turn[i][j] = -rules.turn[i][kTerms - 1 - j];
      mirrored.step[i][j] = rules.step[i][kTerms - 1 - j];
    }
  }
  const auto table = std::make_unique<Bilinear::Table>();
  const auto mirrored_table = std::make_unique<Bilinear::Table>();
  generate<Bilinear>(rules, *table);
  generate<Bilinear>(mirrored, *mirrored_table);
  const Bilinear bilinear{*table};
  const Bilinear bilinear_mirrored{*mirrored_table};
  const ClosedForm closed{rules};
  const ClosedForm closed_mirrored{mirrored};
  on_a_lattice([&](Inputs in) {
    const Inputs other{in.distance, -in.bias};
    RC_ASSERT(bilinear(in).turn.raw() == -bilinear_mirrored(other).turn.raw());
    RC_ASSERT(bilinear(in).step.raw() == bilinear_mirrored(other).step.raw());
    RC_ASSERT(closed(in).turn.raw() == -closed_mirrored(other).turn.raw());
    RC_ASSERT(closed(in).step.raw() == closed_mirrored(other).step.raw());
  });
}

}  // namespace
}  // namespace whisker::fuzzy

// Random rule bases on a random lattice of inputs. RC_PARAMS="seed=N" repeats a run.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>
#include <memory>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/generate.hpp"
#include "tests/fuzzy/closed_form.hpp"
#include "tests/fuzzy/corners.hpp"
#include "tests/fuzzy/inputs.hpp"

namespace whisker::fuzzy {
namespace {

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

#include "firmware/fuzzy/rules.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/exact.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/scale.hpp"
#include "host/lab/tools/table_text.hpp"
#include "tests/fuzzy/closed_form.hpp"
#include "tests/fuzzy/inputs.hpp"

namespace whisker::fuzzy {
namespace {

using Centres = std::array<double, kTerms>;

constexpr int kCentre = 2;

TEST(Rules, TurnAwayFromTheNearerSide) {
  for (int d = 0; d < kTerms; ++d) {
    for (int r = 0; r < kCentre; ++r) EXPECT_GE(kRules.turn[d][r], Q14{}) << d << ' ' << r;
    for (int r = kCentre + 1; r < kTerms; ++r) EXPECT_LE(kRules.turn[d][r], Q14{}) << d << ' ' << r;
  }
  EXPECT_LT(kRules.turn[0][3], Q14{});
}

TEST(Rules, TurnHarderTheNearerTheObstacle) {
  for (int d = 1; d < kTerms; ++d)
    for (int r = kCentre; r < kTerms; ++r)
      EXPECT_LE(kRules.turn[d - 1][r], kRules.turn[d][r]) << d << ' ' << r;
}

TEST(Rules, TurnHarderTheMoreTheSidesDiffer) {
  for (int d = 0; d < kTerms; ++d)
    for (int r = kCentre + 1; r < kTerms; ++r)
      EXPECT_LE(kRules.turn[d][r], kRules.turn[d][r - 1]) << d << ' ' << r;
}

TEST(Rules, GoStraightOnWhereNothingIsNear) {
  for (int r = 0; r < kTerms; ++r) EXPECT_EQ(kRules.turn[kTerms - 1][r], Q14{}) << r;
}

TEST(Rules, ShortenTheStepTowardAnObstacle) {
  for (int d = 1; d < kTerms; ++d) {
    for (int r = 0; r < kTerms; ++r) EXPECT_LE(kRules.step[d - 1][r], kRules.step[d][r]) << d << ' ' << r;
    EXPECT_LT(kRules.step[d - 1][kCentre], kRules.step[d][kCentre]) << d;
  }
}

TEST(Rules, NeverStopTheStep) {
  for (const auto& row : kRules.step)
    for (const Q14 answer : row) EXPECT_GE(answer, Q14::ratio(3, 10));
}

// Exact inference compared with the formula in floating point, written from the definition alone.

constexpr Centres kD = {1, 3, 5, 7, 9};
constexpr Centres kR = {-7, -4, 0, 4, 7};

double triangle(const Centres& centres, std::size_t i, double x) {
  const double inside = std::clamp(x, centres.front(), centres.back());
  const double rise = i == 0 ? 1 : (inside - centres[i - 1]) / (centres[i] - centres[i - 1]);
  const double fall = i == kTerms - 1 ? 1 : (centres[i + 1] - inside) / (centres[i + 1] - centres[i]);
  return std::clamp(std::min(rise, fall), 0.0, 1.0);
}

double inferred(const Q14 (&picture)[kTerms][kTerms], double d, double r) {
  double sum = 0;
  double weight = 0;
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t j = 0; j < kTerms; ++j) {
      const double w = std::min(triangle(kD, i, d), triangle(kR, j, r));
      sum += w * picture[i][j].raw();
      weight += w;
    }
  }
  return sum / weight;
}

TEST(Exact, IsTheFormulaRoundedToTheNearestUnitOnEveryInput) {
  const Exact exact{kRules};
  double largest = 0;
  for_every_input([&](Inputs in) {
    const double d = in.distance.raw() / 128.0;
    const double r = in.bias.raw() / 128.0;
    const Response response = exact(in);
    largest = std::max({largest, std::abs(response.turn.raw() - inferred(kRules.turn, d, r)),
                        std::abs(response.step.raw() - inferred(kRules.step, d, r))});
  });
  std::printf("exact inference: at most %.9f raw units off the formula\n", largest);
  EXPECT_LE(largest, 0.5 + 1e-9);
}

TEST(Exact, MembershipsOfEveryInputSumToOne) {
  for (int x = -kBiasMax; x <= kDistanceMax; ++x) {
    int d = 0;
    int r = 0;
    for (int i = 0; i < kTerms; ++i) {
      d += membership(kDistanceCentres, i, x);
      r += membership(kBiasCentres, i, x);
    }
    ASSERT_EQ(d, kFull) << x;
    ASSERT_EQ(r, kFull) << x;
  }
}

TEST(Exact, RoundsTiesAwayFromZero) {
  RuleBase rules{};
  rules.turn[0][2] = Q14::from_raw(1);
  rules.step[0][2] = Q14::from_raw(-1);
  const Response halfway = Exact{rules}(inputs(256, 0));
  EXPECT_EQ(halfway.turn.raw(), 1);
  EXPECT_EQ(halfway.step.raw(), -1);
}

TEST(Exact, GivesARulesOwnAnswerWhereItAloneIsTrue) {
  const Exact exact{kRules};
  for (int i = 0; i < kTerms; ++i) {
    for (int j = 0; j < kTerms; ++j) {
      const Response response = exact(inputs(kDistanceCentres[i], kBiasCentres[j]));
      EXPECT_EQ(response.turn, kRules.turn[i][j]) << i << ' ' << j;
      EXPECT_EQ(response.step, kRules.step[i][j]) << i << ' ' << j;
    }
  }
}

// Beyond the outer centres the output is constant, up to the limits of the input type.

bool operator==(const Response& a, const Response& b) {
  return a.turn == b.turn && a.step == b.step && a.cell.distance == b.cell.distance &&
         a.cell.bias == b.cell.bias;
}

Inputs limited(int distance, int bias) {
  return inputs(std::clamp<int>(distance, kDistanceLow, kDistanceHigh),
                std::clamp<int>(bias, kBiasLow, kBiasHigh));
}

template <class Engine>
int unsaturated_inputs(const Engine& engine) {
  int count = 0;
  for (int wild = INT16_MIN; wild <= INT16_MAX; ++wild) {
    for (const int tame : {0, 128, 129, 500, 1151, 1152, 1280})
      count += !(engine(inputs(tame, wild)) == engine(limited(tame, wild)));
    for (const int tame : {-1024, -896, -895, -3, 0, 3, 895, 896, 1024})
      count += !(engine(inputs(wild, tame)) == engine(limited(wild, tame)));
  }
  for (const int d : {INT16_MIN, INT16_MAX})
    for (const int r : {INT16_MIN, INT16_MAX}) count += !(engine(inputs(d, r)) == engine(limited(d, r)));
  return count;
}

TEST(Bilinear, SaturatesBeyondEveryEdge) { EXPECT_EQ(unsaturated_inputs(Bilinear{kResponseTable}), 0); }
TEST(ClosedForm, SaturatesBeyondEveryEdge) { EXPECT_EQ(unsaturated_inputs(ClosedForm{kRules}), 0); }
TEST(Exact, SaturatesBeyondEveryEdge) { EXPECT_EQ(unsaturated_inputs(Exact{kRules}), 0); }

template <class Engine>
void expect_the_corner_rules(const Engine& engine) {
  for (const int i : {0, kTerms - 1}) {
    for (const int j : {0, kTerms - 1}) {
      const Response at = engine(inputs(i == 0 ? 0 : kDistanceMax, j == 0 ? -kBiasMax : kBiasMax));
      EXPECT_EQ(at.turn, kRules.turn[i][j]) << i << ' ' << j;
      EXPECT_EQ(at.step, kRules.step[i][j]) << i << ' ' << j;
    }
  }
}

TEST(Bilinear, AnswersTheCornerRulesAtTheCorners) { expect_the_corner_rules(Bilinear{kResponseTable}); }
TEST(ClosedForm, AnswersTheCornerRulesAtTheCorners) { expect_the_corner_rules(ClosedForm{kRules}); }
TEST(Exact, AnswersTheCornerRulesAtTheCorners) { expect_the_corner_rules(Exact{kRules}); }

TEST(Scale, MapsTheRangesOfTheSensorsToTheRangesOfTheInputs) {
  const Inputs clear_right = scale(0_mm, 2_m, 2_m, 2_m);
  EXPECT_EQ(clear_right.distance.raw(), kDistanceMax);
  EXPECT_EQ(clear_right.bias.raw(), kBiasMax);
  const Inputs clear_left = scale(2_m, 0_mm, 0_mm, 2_m);
  EXPECT_EQ(clear_left.distance.raw(), 0);
  EXPECT_EQ(clear_left.bias.raw(), -kBiasMax);
}

TEST(Scale, TakesTheFrontDistance) { EXPECT_EQ(scale(300_mm, 600_mm, 1200_mm, 2_m).distance.raw(), 384); }

TEST(Scale, CountsDistancesWithinZeroAndTheMaximumRange) {
  const Length far = Length::from_raw(INT32_MAX);
  const Length behind = Length::from_raw(INT32_MIN);
  const Inputs most = scale(far, far, far, 2_m);
  EXPECT_EQ(most.distance.raw(), kDistanceMax);
  EXPECT_EQ(most.bias.raw(), 0);
  EXPECT_EQ(scale(behind, behind, behind, 2_m).distance.raw(), 0);
  EXPECT_EQ(scale(behind, far, far, 60_m).bias.raw(), kBiasMax);
}

Length any_length() {
  return millimetres(*rc::gen::inRange(-500, 70000)) + micrometres(*rc::gen::inRange(0, 1000));
}

double counted(Length x, Length max_range) {
  return std::clamp(double(x.raw()), 0.0, double(max_range.raw())) / max_range.raw();
}

RC_GTEST_PROP(Scale, IsTheFormulaRoundedToTheNearestUnit, ()) {
  const Length max_range = millimetres(*rc::gen::inRange(200, 60001));
  const Length left = any_length();
  const Length front = any_length();
  const Length right = any_length();
  const double l = counted(left, max_range);
  const double f = counted(front, max_range);
  const double r = counted(right, max_range);
  const Inputs got = scale(left, front, right, max_range);
  RC_ASSERT(std::abs(got.distance.raw() - 1280 * f) <= 0.5 + 1e-9);
  RC_ASSERT(std::abs(got.bias.raw() - 1024 * (r - l)) <= 0.5 + 1e-9);
}

RC_GTEST_PROP(Scale, MirrorsExactlyWhenTheSidesAreSwapped, ()) {
  const Length max_range = millimetres(*rc::gen::inRange(200, 60001));
  const Length left = any_length();
  const Length front = any_length();
  const Length right = any_length();
  const Inputs here = scale(left, front, right, max_range);
  const Inputs there = scale(right, front, left, max_range);
  RC_ASSERT(here.distance == there.distance);
  RC_ASSERT(here.bias.raw() == -there.bias.raw());
}

// The committed table and the figures in the documentation follow from the rules.

std::string contents(const char* path) {
  std::ifstream file{std::string{WHISKER_SOURCE_DIR} + path, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

TEST(ResponseTable, IsByteForByteWhatTheRulesGenerate) {
  const std::string committed = contents("/firmware/fuzzy/response_table.hpp");
  ASSERT_FALSE(committed.empty());
  EXPECT_TRUE(committed == tools::response_table_text(kRules)) << "build the target generate_table";
}

TEST(ResponseTable, ChangesItsTextWithOneUnitOfOneRule) {
  RuleBase rules = kRules;
  rules.step[4][2] = Q14::from_raw(static_cast<std::int16_t>(rules.step[4][2].raw() + 1));
  EXPECT_FALSE(contents("/firmware/fuzzy/response_table.hpp") == tools::response_table_text(rules));
}

TEST(ResponseTable, ChangesItsResponseWithOneUnitOfAnyNode) {
  Bilinear::Table table = kResponseTable;
  const Bilinear bilinear{table};
  for (int d = 0; d < Bilinear::kDistanceNodes; ++d) {
    for (int r = 0; r < Bilinear::kBiasNodes; ++r) {
      const Inputs at =
          inputs(kDistanceLow + d * Bilinear::kDistanceSpacing, kBiasLow + r * Bilinear::kBiasSpacing);
      const Response before = bilinear(at);
      Bilinear::Node& node = table.node[d][r];
      ++node.turn;
      ASSERT_EQ(bilinear(at).turn.raw(), before.turn.raw() + 1) << d << ' ' << r;
      ASSERT_EQ(bilinear(at).step, before.step) << d << ' ' << r;
      --node.turn;
      --node.step;
      ASSERT_EQ(bilinear(at).turn, before.turn) << d << ' ' << r;
      ASSERT_EQ(bilinear(at).step.raw(), before.step.raw() - 1) << d << ' ' << r;
      ++node.step;
    }
  }
}

}  // namespace
}  // namespace whisker::fuzzy

// Beyond the outer centres the output is constant, up to the limits of the input type.
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/exact.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "tests/fuzzy/closed_form.hpp"
#include "tests/fuzzy/inputs.hpp"

namespace whisker::fuzzy {
namespace {

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

}  // namespace
}  // namespace whisker::fuzzy

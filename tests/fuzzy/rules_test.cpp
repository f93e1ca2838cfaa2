#include "firmware/fuzzy/rules.hpp"

#include <gtest/gtest.h>

namespace whisker::fuzzy {
namespace {

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

}  // namespace
}  // namespace whisker::fuzzy

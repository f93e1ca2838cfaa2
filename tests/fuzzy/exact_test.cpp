// Exact inference compared with the formula in floating point, written from the definition alone.
#include "firmware/fuzzy/exact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "firmware/fuzzy/rules.hpp"
#include "tests/fuzzy/inputs.hpp"

namespace whisker::fuzzy {
namespace {

using Centres = std::array<double, kTerms>;
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

}  // namespace
}  // namespace whisker::fuzzy

/// The variables of the fuzzy controller, their terms, and the types that all engines share.
///
/// | | meaning | range | raw unit |
/// |---|---|---|---|
/// | D | distance to the obstacles ahead | [0, 10] | 1/128 |
/// | R | right distance - left distance; positive: an obstacle nearer on the left | [-8, 8] | 1/128 |
/// | SA | turn factor; positive: turn left | [-1.5, 1.5] | 1/16384 |
/// | SD | step factor | [0, 2) | 1/16384 |
///
/// docs/rules.md separates the source's figures from reconstructed ones.
#pragma once

#include <stdint.h>

#include "firmware/math/fixed.hpp"

namespace whisker::fuzzy {

struct alignas(int) Inputs {
  Q7 distance;  ///< D
  Q7 bias;      ///< R
};

/// Cell of the table that the engine used: its lower corner, counted from the smallest D and R.
struct Cell {
  uint8_t distance;
  uint8_t bias;
};

struct Response {
  Q14 turn;  ///< SA
  Q14 step;  ///< SD
  Cell cell{};
};

constexpr int kTerms = 5;

/// Centre of each term of D (VS S M B VB) and of R (RVB RB CE LB LVB); raw Q7.
constexpr int16_t kDistanceCentres[kTerms] = {128, 384, 640, 896, 1152};
constexpr int16_t kBiasCentres[kTerms] = {-896, -512, 0, 512, 896};

/// Beyond its outer centres an input has no further effect: the outer terms are shoulders.
constexpr int16_t kDistanceLow = kDistanceCentres[0];
constexpr int16_t kDistanceHigh = kDistanceCentres[kTerms - 1];
constexpr int16_t kBiasLow = kBiasCentres[0];
constexpr int16_t kBiasHigh = kBiasCentres[kTerms - 1];
constexpr int16_t kDistanceSpan = kDistanceHigh - kDistanceLow;
constexpr int16_t kBiasSpan = kBiasHigh - kBiasLow;

/// A membership of 1. Every gap between neighbouring centres divides it, so memberships are exact integers.
constexpr int16_t kFull = 1536;

constexpr bool gaps_divide_full(const int16_t (&centres)[kTerms]) noexcept {
  for (int i = 1; i < kTerms; ++i)
    if (centres[i] <= centres[i - 1] || kFull % (centres[i] - centres[i - 1]) != 0) return false;
  return true;
}
static_assert(gaps_divide_full(kDistanceCentres) && gaps_divide_full(kBiasCentres));

/// The outputs of the 25 rules, by the terms of D and R. Any values are allowed.
struct RuleBase {
  Q14 turn[kTerms][kTerms];
  Q14 step[kTerms][kTerms];
};

}  // namespace whisker::fuzzy

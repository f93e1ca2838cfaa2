/// The fuzzy stage's inputs, for iteration in tests.
#pragma once

#include <cstdint>

#include "firmware/fuzzy/variables.hpp"

namespace whisker::fuzzy {

constexpr int kDistanceMax = 10 * Q7::kOne;
constexpr int kBiasMax = 8 * Q7::kOne;

constexpr Inputs inputs(int distance, int bias) {
  return {Q7::from_raw(static_cast<std::int16_t>(distance)), Q7::from_raw(static_cast<std::int16_t>(bias))};
}

/// Calls f(inputs) for each of the 1281 x 2049 pairs within the ranges of D and R.
template <class F>
void for_every_input(F&& f) {
  for (int d = 0; d <= kDistanceMax; ++d)
    for (int r = -kBiasMax; r <= kBiasMax; ++r) f(inputs(d, r));
}

}  // namespace whisker::fuzzy

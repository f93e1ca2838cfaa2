/// Fills a look-up table from a rule base, in integers: the same table on every machine.
#pragma once

#include "firmware/fuzzy/exact.hpp"

namespace whisker::fuzzy {

/// Every node gets the exact answer for its inputs.
template <class Grid>
constexpr void generate(const RuleBase& rules, typename Grid::Table& out) noexcept {
  const Exact exact{rules};
  for (uint8_t d = 0; d < Grid::kDistanceNodes; ++d) {
    for (uint8_t r = 0; r < Grid::kBiasNodes; ++r) {
      const int32_t distance = kDistanceLow + int32_t{d} * Grid::kDistanceSpacing;
      const int32_t bias = kBiasLow + int32_t{r} * Grid::kBiasSpacing;
      const Response at =
          exact({Q7::from_raw(static_cast<int16_t>(distance)), Q7::from_raw(static_cast<int16_t>(bias))});
      out.node[d][r] = {at.turn.raw(), at.step.raw()};
    }
  }
}

}  // namespace whisker::fuzzy

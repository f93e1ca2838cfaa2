/// From the three distances to the two fuzzy inputs.
#pragma once

#include "firmware/fuzzy/variables.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"

namespace whisker::fuzzy {

/// D = 10 front / max_range; R = 8 (right - left) / max_range. Distances are limited to [0, max_range]. Both
/// results are rounded to nearest, ties away from zero, so that swapped sides give exactly -R. 0 < max_range.
Inputs scale(Length left, Length front, Length right, Length max_range) noexcept;

}  // namespace whisker::fuzzy

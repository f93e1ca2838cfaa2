/// How exact answers change from one raw input to the next.
#pragma once

#include <cstdint>

#include "host/rules/surface.hpp"

namespace whisker::rules {

/// Of one output along one axis, over all lines of the domain.
struct Slopes {
  double rises = 0;  ///< sums of all changes
  double falls = 0;
  double greatest_rise = 0;  ///< greatest rise after a lower, and fall after a higher answer on the same line
  double greatest_fall = 0;
  std::int32_t rise_at[2] = {0, 0};
  std::int32_t fall_at[2] = {0, 0};
  double step = 0;                   ///< greatest difference of neighbours
  std::int32_t step_at[2] = {0, 0};  ///< the lower neighbour
};

Slopes slopes(const Surface& surface, std::size_t output, std::size_t part);

}  // namespace whisker::rules

/// Mirror symmetry of exact answers.
#pragma once

#include <cstdint>
#include <vector>

#include "host/lab/rules/surface.hpp"

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

/// An output mirrored in one input about the middle of the input's range.
struct Symmetry {
  std::size_t output = 0;
  std::size_t part = 0;         ///< of the domain
  bool odd = false;             ///< the mirrored answer is negated about `centre`, else the same
  double centre = 0;            ///< of an odd output
  double broken_by = 0;         ///< greatest difference; 0 if exact within 1e-9 of the span
  std::int32_t at[2] = {0, 0};  ///< raw inputs where it is attained
};

/// Exact symmetries, and those that hold within 1 % of the span at three of four inputs.
std::vector<Symmetry> symmetries(const Surface& surface, const std::vector<double>& spans);

}  // namespace whisker::rules

/// Mirror symmetry of exact answers.
#pragma once

#include <cstdint>
#include <vector>

#include "host/rules/surface.hpp"

namespace whisker::rules {

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

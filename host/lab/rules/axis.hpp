/// The integer domain of an input: every value that a table can be asked for.
#pragma once

#include <cstdint>
#include <vector>

#include "host/lab/rules/rule_base.hpp"

namespace whisker::rules {

/// Fewest steps over the range of an input without its own resolution, unless the user asks for others.
constexpr int kFewestSteps = 1024;
/// Most steps over the range of an input with its own resolution.
constexpr int kMostRangeSteps = 32768;

/// value = origin + raw / per_unit, for every raw from low to high.
struct Axis {
  std::size_t input = 0;
  double origin = 0;
  double per_unit = 1;
  std::int32_t low = 0;
  std::int32_t high = 1;

  double value(std::int32_t raw) const { return origin + raw / per_unit; }
  std::int32_t count() const { return high - low + 1; }
};

/// The input's own resolution, or the coarsest with at least `fewest` steps over the range: the corners of
/// the terms lie on raw values if at most 256 equal parts of the range have all of them on their borders.
/// Origin 0 if raw values then fit in 16 bits, else the lower end of the range. False: the given resolution
/// does not fit the range.
bool make_axis(const RuleBase& base, std::size_t input, int fewest, Axis& out);

}  // namespace whisker::rules

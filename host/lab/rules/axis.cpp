#include "host/lab/rules/axis.hpp"

#include <cmath>

namespace whisker::rules {
namespace {

constexpr int kMostParts = 256;

bool whole(double x) { return std::abs(x - std::round(x)) < 1e-9 * (1 + std::abs(x)); }

/// The fewest equal parts of the range that have every corner of a term on a border; 1 if there are none.
int parts_of(const Input& input) {
  std::vector<double> corners;
  for (const Term& term : input.terms)
    for (const double x : term.set.breaks())
      if (x > input.low && x < input.high) corners.push_back((x - input.low) / (input.high - input.low));
  for (int n = 1; n <= kMostParts; ++n) {
    bool all = true;
    for (const double c : corners) all = all && whole(c * n);
    if (all) return n;
  }
  return 1;
}

}  // namespace

bool make_axis(const RuleBase& base, std::size_t index, int fewest, Axis& out) {
  const Input& input = base.inputs[index];
  const double range = input.high - input.low;
  out.input = index;
  if (input.raw_per_unit) {
    out.per_unit = *input.raw_per_unit;
    const double steps = range * out.per_unit;
    if (!whole(steps) || steps < 1 || steps > kMostRangeSteps) return false;
  } else {
    int steps = parts_of(input);
    while (steps < fewest) steps *= 2;
    out.per_unit = steps / range;
  }
  const double low = input.low * out.per_unit;
  const double high = input.high * out.per_unit;
  const bool from_zero = whole(low) && std::abs(low) <= INT16_MAX && std::abs(high) <= INT16_MAX;
  out.origin = from_zero ? 0 : input.low;
  out.low = from_zero ? static_cast<std::int32_t>(std::lround(low)) : 0;
  out.high = out.low + static_cast<std::int32_t>(std::lround(range * out.per_unit));
  return out.high <= INT16_MAX;
}

}  // namespace whisker::rules

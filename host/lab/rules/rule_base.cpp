#include "host/lab/rules/rule_base.hpp"

#include <cmath>

#include "host/harness/scenario/error.hpp"

namespace whisker::rules {

void fail(const RuleBase& base, Place at, const std::string& what) {
  throw InputError(base.file, at.line, at.column, what);
}

namespace {

double apply(Hedge hedge, double x) {
  switch (hedge) {
    case Hedge::negation: return 1 - x;
    case Hedge::very: return x * x;
    case Hedge::cubed: return x * x * x;
    case Hedge::very_very: return x * x * x * x;
    case Hedge::somewhat: return std::sqrt(x);
    case Hedge::extremely: return x <= 0.5 ? 2 * x * x : 1 - 2 * (1 - x) * (1 - x);
    case Hedge::seldom: return x <= 0.5 ? std::sqrt(x / 2) : 1 - std::sqrt((1 - x) / 2);
  }
  return x;
}

}  // namespace

double hedged(double degree, const std::vector<Hedge>& hedges) {
  for (auto hedge = hedges.rbegin(); hedge != hedges.rend(); ++hedge) degree = apply(*hedge, degree);
  return degree;
}

}  // namespace whisker::rules

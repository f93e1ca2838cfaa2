/// From a rule base to a table with a proven bound.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/lab/rules/search.hpp"

namespace whisker::rules {

struct Options {
  Demand demand;
  std::vector<Fixed> fixed;
  int fewest_steps = kFewestSteps;  ///< over the range of an input without its own resolution
};

/// Inputs where no rule fires for an output.
struct Gap {
  std::size_t output = 0;
  double share = 0;              ///< of the representable inputs
  std::int32_t low[2] = {0, 0};  ///< box of raw inputs around them
  std::int32_t high[2] = {0, 0};
  double answer = 0;  ///< what is answered there
};

struct Compiled {
  RuleBase base;
  Surface surface;
  Table table;
  std::vector<double> spans;
  std::vector<Error> errors;
  std::vector<std::size_t> never;  ///< rules that never fire
  std::vector<Gap> gaps;
  std::vector<Symmetry> symmetries;
  double seconds = 0;
};

/// Throws InputError if the rule base cannot be compiled as demanded.
Compiled compile(RuleBase base, const Options& options);

}  // namespace whisker::rules

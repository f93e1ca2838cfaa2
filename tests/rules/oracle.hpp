/// fuzzylite as an independent implementation.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/lab/rules/inference.hpp"

namespace whisker::test {

/// Differences of the exact inference from fuzzylite.
struct Agreement {
  int points = 0;         ///< compared answers
  int silent = 0;         ///< answers where no rule fires, in both
  double greatest = 0;    ///< greatest difference beyond fuzzylite's own resolution error, share of the range
  std::string disagrees;  ///< the first wrong answer in words; empty if all are right
};

/// Compares at `points` pseudo-random inputs of the seed, and at the corners of the ranges. fuzzylite reads
/// the text itself; `format` is "fll", "fis" or "fcl". What fuzzylite defines otherwise is taken over into
/// `base` first: the least strength of a rule, and for .fcl the weighted average over rules.
Agreement compare(const std::string& text, const std::string& format, rules::RuleBase base, int points,
                  unsigned seed);

/// False if fuzzylite defines a defuzzifier otherwise than the format: mom, som and lom of MATLAB, MM of
/// .fcl.
bool comparable(const rules::RuleBase& base);

}  // namespace whisker::test

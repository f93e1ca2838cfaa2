/// What a user should know about a rule base before relying on it.
#pragma once

#include <string>
#include <vector>

#include "host/lab/rules/compile.hpp"

namespace whisker::rules {

enum class Kind { never_fires, no_rule, broken_symmetry, not_monotone, discontinuity };

/// "never_fires" and so on.
const char* name(Kind kind);

struct Finding {
  Kind kind;
  std::string text;  ///< one line
};

std::vector<Finding> findings(const Compiled& compiled);

/// Greatest change of an output when each input is rounded to its raw unit: half of the greatest difference
/// of neighbours, summed over the inputs.
double rounding_effect(const Compiled& compiled, std::size_t output);

/// A difference of answers, per cent of the output's span; 0 if that is 0.
double percent(const Compiled& compiled, std::size_t output, double difference);

/// "service = 2.5, food = 3": the inputs of a table at raw values.
std::string where(const Compiled& compiled, const std::int32_t* raw);

}  // namespace whisker::rules

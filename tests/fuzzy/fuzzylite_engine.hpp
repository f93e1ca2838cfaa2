#pragma once

#include <memory>

#include <fl/Headers.h>

#include "firmware/fuzzy/variables.hpp"

namespace whisker::fuzzy {

/// The same rules in fuzzylite: minimum, weighted average over rules. Inputs "D" and "R", outputs "SA" and
/// "SD".
std::unique_ptr<fl::Engine> fuzzylite_engine(const RuleBase& rules);

}  // namespace whisker::fuzzy

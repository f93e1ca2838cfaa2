#pragma once

#include <limits>

namespace whisker {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace whisker

/// A table as a header for C99 and C++17.
#pragma once

#include <string>
#include <string_view>

#include "host/lab/rules/compile.hpp"

namespace whisker::rules {

/// Ranges, scales, nodes and the look-up in integers. Every name begins with the stem of `path` in lower
/// case, every macro with it in upper case.
std::string header(const Compiled& compiled, std::string_view path);

}  // namespace whisker::rules

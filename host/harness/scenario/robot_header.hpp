#pragma once

#include <string>

#include "firmware/params.hpp"

namespace whisker {

/// A C++ header with `constexpr whisker::Params my_robot()`: the differences from the reference robot, and a
/// static_assert on check(). source: the file from which it was generated.
std::string robot_header(const Params& params, const std::string& source);

}  // namespace whisker

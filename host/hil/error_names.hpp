#pragma once

#include <cstdint>
#include <string>

namespace whisker::hil {

/// The names of the error bits that are set.
std::string error_names(std::uint16_t errors);

}  // namespace whisker::hil

#pragma once

#include <cstdint>
#include <string>

namespace whisker::hil {

/// The names of the error bits that are set.
std::string words_of(std::uint16_t errors);

}  // namespace whisker::hil

/// Random rule bases as .fll and .fis text.
#pragma once

#include <cstdint>
#include <string>

namespace whisker::test {

/// Equal seeds give equal texts. One or two inputs, one or two outputs, every shape and operator that both
/// Whisker and fuzzylite have.
std::string random_fll(std::uint64_t seed);

}  // namespace whisker::test

#pragma once

#include <cstdint>

namespace whisker::test {

/// Number of calls of operator new so far.
std::uint64_t allocations();

}  // namespace whisker::test

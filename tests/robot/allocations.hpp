#pragma once

#include <cstdint>

namespace whisker::test {

/// How often this program has called operator new so far.
std::uint64_t allocations();

}  // namespace whisker::test

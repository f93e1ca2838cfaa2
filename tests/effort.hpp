/// How many random worlds a test takes.
#pragma once

#include <cstdint>

namespace whisker::test {

/// `full` in an optimised build; a sixth, at least one, under sanitizers and for coverage, which are
/// about ten times slower and look for other faults.
constexpr std::uint64_t effort(std::uint64_t full) noexcept {
#if defined(__SANITIZE_ADDRESS__) || !defined(__OPTIMIZE__)
  return (full + 5) / 6;
#else
  return full;
#endif
}

}  // namespace whisker::test

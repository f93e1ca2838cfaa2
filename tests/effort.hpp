/// How many random worlds a test takes.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace whisker::test {

/// `full` in a release build; a sixth, at least one, in builds with sanitizers or coverage, which are about
/// ten times slower and search for other faults (tests/CMakeLists.txt).
constexpr std::uint64_t effort(std::uint64_t full) noexcept {
#ifdef WHISKER_LESS_EFFORT
  return (full + 5) / 6;
#else
  return full;
#endif
}

/// `usual` as above; `whole` with WHISKER_LONG=1, as in the stage long.
inline std::uint64_t effort(std::uint64_t usual, std::uint64_t whole) noexcept {
  return std::getenv("WHISKER_LONG") != nullptr ? whole : effort(usual);
}

}  // namespace whisker::test

/// How many random worlds a test takes.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace whisker::test {

/// `whole` with WHISKER_LONG=1, as in the stage long; otherwise `usual`.
inline std::uint64_t effort(std::uint64_t usual, std::uint64_t whole) noexcept {
  return std::getenv("WHISKER_LONG") != nullptr ? whole : usual;
}

/// The same, where a sixth, at least one, is usual.
inline std::uint64_t effort(std::uint64_t whole) noexcept { return effort((whole + 5) / 6, whole); }

}  // namespace whisker::test

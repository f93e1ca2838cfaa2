/// How many random worlds a test takes.
#pragma once

#include <cstdint>

// How GCC and clang tell of the sanitizer.
#if defined(__SANITIZE_ADDRESS__)
#define WHISKER_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define WHISKER_SANITIZED
#endif
#endif

namespace whisker::test {

/// `full` in an optimised build; a sixth, at least one, under sanitizers and for coverage, which are
/// about ten times slower and look for other faults.
constexpr std::uint64_t effort(std::uint64_t full) noexcept {
#if defined(WHISKER_SANITIZED) || !defined(__OPTIMIZE__)
  return (full + 5) / 6;
#else
  return full;
#endif
}

}  // namespace whisker::test

/// Preconditions. They are checked in builds that define WHISKER_ASSERTS, which are those of the tests: a
/// chip spends nothing on them.
#pragma once

#ifdef WHISKER_ASSERTS
namespace whisker {
/// Ends the program. The build that asserts defines it.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line) noexcept;
}  // namespace whisker
#define WHISKER_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::whisker::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define WHISKER_ASSERT(condition) static_cast<void>(0)
#endif

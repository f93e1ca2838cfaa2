// What becomes of a violated precondition in the builds of the tests.
#include <cstdio>
#include <cstdlib>

#include "firmware/math/assert.hpp"

namespace whisker {

void assertion_failed(const char* condition, const char* file, int line) noexcept {
  std::fprintf(stderr, "%s:%d: the precondition does not hold: %s\n", file, line, condition);
  std::abort();
}

}  // namespace whisker

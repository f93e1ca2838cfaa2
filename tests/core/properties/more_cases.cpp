#include <cstdlib>

namespace {

// rapidcheck's own hundred cases are few; a caller's RC_PARAMS comes first.
const bool kMoreCases = setenv("RC_PARAMS", "max_success=500", 0) == 0;

}  // namespace

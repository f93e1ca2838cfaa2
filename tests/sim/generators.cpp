#include <cstdlib>

namespace {

// rapidcheck's own hundred cases are few for geometry; a caller's RC_PARAMS comes first.
const bool kMoreCases = setenv("RC_PARAMS", "max_success=1000", 0) == 0;

}  // namespace

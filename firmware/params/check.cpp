// Separate from params.cpp, because an image that checks its parameters at compile time does not need it.
#include "firmware/params.hpp"

namespace whisker {

ParamFault at_run_time::check(const Params& p) noexcept { return formula::check(p); }

}  // namespace whisker

// Separate from params.cpp, because an image that checks its parameters at compile time needs none of this,
// nor its 3.5 KB of sentences.
#include "firmware/params.hpp"

namespace whisker {

ParamFault at_run_time::check(const Params& p) noexcept { return formula::check(p); }

const char* name(ParamFault fault) noexcept { return relation(fault).name; }

}  // namespace whisker

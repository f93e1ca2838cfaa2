// Separate from check.cpp, because only an image that names the fault needs 4.6 KB of sentences.
#include "firmware/params.hpp"

namespace whisker {

const char* name(ParamFault fault) noexcept { return relation(fault).name; }

}  // namespace whisker

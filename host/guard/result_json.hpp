/// The result of a drive as one JSON object.
#pragma once

#include <string>

#include "host/guard/drive.hpp"

namespace whisker::guard {

/// On one line. `outcome`: reached, contact, fault, gave_up (out of time) or ended. `hash` is that of the
/// commands, in hex.
std::string result_json(const Result& result);

}  // namespace whisker::guard

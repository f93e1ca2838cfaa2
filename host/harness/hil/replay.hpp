#pragma once

#include <istream>
#include <string>

#include "host/harness/hil/replayer.hpp"

namespace whisker::hil {

/// Feeds the recorded inputs to the core and compares its outputs with the recorded ones; of a guard node,
/// the commands alone, and `stepped` is not called. The log of a guard node has a GuardStatus before the
/// first mission. `name` is the name of the log in messages. Throws as LogReader, and std::runtime_error for
/// what cannot be replayed.
ReplayResult replay(std::istream& log, const std::string& name, const ReplayOptions& options);

}  // namespace whisker::hil

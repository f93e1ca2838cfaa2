/// The smallest case that fails in the same way.
#pragma once

#include <string>

#include "host/hunt/case.hpp"

namespace whisker::hunt {

/// What breaks the promise when the case is driven in a process of its own: Outcome::finding, or "crash
/// signal 8"; empty: nothing. Case::commands becomes what an Attacker commanded, unless the drive crashed.
std::string finding_of(Case& c);

/// Gives keys their default back, removes obstacles, commands, noise and gaps, and shortens the time, as long
/// as the premise holds and the finding stays the same. At most `tries` drives.
Case shrunk(const Case& c, const std::string& finding, int tries);

}  // namespace whisker::hunt

/// The smallest case that fails in the same way.
#pragma once

#include <functional>
#include <string>

#include "host/lab/hunt/case.hpp"

namespace whisker::hunt {

/// What breaks the promise when the case is driven in a process of its own: Outcome::finding, or "crash
/// signal 8"; empty: nothing. Case::commands becomes what an Attacker commanded, unless the drive crashed.
std::string finding_of(Case& c);

struct Effort {
  int drives;      ///< at most
  double seconds;  ///< no drive begins later
};
/// True if the case still fails; it may fill in Case::commands.
using Fails = std::function<bool(Case&)>;

/// Gives keys their default back, removes obstacles, commands, noise and gaps, as long as the premise holds
/// and the case fails.
Case shrunk(const Case& c, const Fails& fails, const Effort& effort);

}  // namespace whisker::hunt

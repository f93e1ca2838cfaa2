#pragma once

#include "host/harness/sim/geometry.hpp"

namespace whisker::worlds {

/// The unit vector at this heading, degrees in [-3600, 3600]. Without libm, so every machine gives the same
/// bits. Error below 1e-15.
sim::Vec2 direction(double degrees);

}  // namespace whisker::worlds

// The core's units as numbers in SI units: m, s, rad.
#pragma once

#include "firmware/math/angle.hpp"
#include "firmware/math/units.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {

inline double si(Length x) { return x.raw() / 1e6; }
inline double si(Speed x) { return x.raw() / 1e6; }
inline double si(Acceleration x) { return x.raw() / 1e6; }
inline double si(AngularRate x) { return x.raw() / 1e6; }
inline double si(Duration x) { return x.raw() / 1e3; }
inline double si(Angle x) { return x.wrapped() * (kPi * 0x1p-31); }

}  // namespace whisker::sim

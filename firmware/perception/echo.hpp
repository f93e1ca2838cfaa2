/// A conditioned reading: a distance that knows whether it may be believed.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"
#include "hal/types.hpp"

namespace whisker::perception {

enum class Validity : uint8_t {
  ok,        ///< distance measured
  clear,     ///< nothing within the maximum range; distance is the maximum range
  too_near,  ///< nearer than the minimum range; distance is zero
  pending,   ///< too few readings yet, or they disagree
  invalid,   ///< the sensor says that the reading is lost, or it was out of range
  stale,     ///< no new reading for too long
  stuck,     ///< the same value whatever the body does
};

/// True where the distance is a fact about the world; everything else proves nothing.
constexpr bool usable(Validity v) noexcept { return v <= Validity::too_near; }

struct Echo {
  Length distance;  ///< from the sensor's apex; zero unless usable
  Validity validity = Validity::pending;
};

struct Echoes {
  Echo beam[hal::kBeams];  ///< indexed by hal::Beam
};

constexpr bool usable(const Echoes& e) noexcept {
  return usable(e.beam[0].validity) && usable(e.beam[1].validity) && usable(e.beam[2].validity);
}

}  // namespace whisker::perception

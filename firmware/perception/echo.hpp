/// A conditioned reading: a distance with its validity.
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
  invalid,   ///< the sensor reports a lost reading, or the reading is damaged
  stale,     ///< no new reading for too long
  stuck,     ///< the same value although the body turned
};

/// True if the distance is valid; no other validity says anything about the world.
constexpr bool usable(Validity v) noexcept { return v <= Validity::too_near; }

struct Echo {
  Length distance;  ///< from the apex of the sensor; zero unless usable
  Validity validity = Validity::pending;
};

struct Echoes {
  Echo beam[hal::kBeams];  ///< indexed by hal::Beam
};

constexpr bool usable(const Echoes& e) noexcept {
  return usable(e.beam[0].validity) && usable(e.beam[1].validity) && usable(e.beam[2].validity);
}

/// The nearest thing that any beam shows; zero unless all are usable.
constexpr Length nearest(const Echoes& e) noexcept {
  if (!usable(e)) return {};
  return min(e.beam[0].distance, min(e.beam[1].distance, e.beam[2].distance));
}

}  // namespace whisker::perception

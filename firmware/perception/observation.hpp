/// What one reading of a beam shows.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"

namespace whisker::perception {

/// The place and direction of a beam at the time of a measurement, in the frame of the pose.
struct Beam {
  Vec apex;
  Angle axis;
  Angle half_cone;
};
/// The beam of this mount on a body with this pose.
Beam beam_of(const Mount& mount, const Pose& body) noexcept;

/// Only walls seen at a grazing angle stay invisible to these sensors.
constexpr bool loses_only_grazed(const RangefinderParams& r) noexcept {
  return r.incidence.raw() >= (75_deg).raw();
}

/// Observation of one beam: nothing within its cone is nearer to the apex than `free`.
struct ConeObservation {
  Beam beam;
  int8_t number = 0;   ///< of the beam, a hal::Beam
  Length free;         ///< free distance
  bool hit = false;    ///< an object lies at `free`
  bool aimed = false;  ///< from a static scan: cells that the beam covers and does not clear become tested
  Time taken{};
};

/// The last reading of the same beam.
struct EarlierObservation {
  Vec apex;
  Angle axis;
  Length free;
};

}  // namespace whisker::perception

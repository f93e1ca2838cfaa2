/// The heading of the wall from two turns at places beside each other.
#pragma once

#include <array>
#include <optional>

#include "host/calibration/beam_fit.hpp"

namespace whisker::calibration {

/// The readings of a sweep by the place of the body.
struct Places {
  Sweep first;                  ///< within 3 cm of the first reading
  std::optional<Sweep> second;  ///< within 3 cm of the last one, if that is 0.1 m away or more
  double x_m = 0, y_m = 0;      ///< from the first to the second
};
Places places_of(const Sweep& sweep);

struct Square {
  double wall_deg = 0;
  double error_deg = 0;  ///< standard deviation
};

/// From the difference of the wall's distances. None: too few beams were measured at both places, or the
/// second place does not lie along the wall. near_deg: decides between the two headings that are possible.
std::optional<Square> squared(const Places& places, const std::array<BeamFit, hal::kBeams>& first,
                              const std::array<BeamFit, hal::kBeams>& second, double near_deg);

}  // namespace whisker::calibration

/// Measures the three beams and says what to write into the robot file.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "firmware/params.hpp"
#include "host/lab/calibration/beam_fit.hpp"

namespace whisker::calibration {

extern const char* const kBeamNames[hal::kBeams];  ///< left, front, right

struct Calibration {
  std::array<Believed, hal::kBeams> believed{};
  std::array<BeamFit, hal::kBeams> fits{};
  double wall_deg = 0;
  /// Two turns at places beside each other tell the heading of the wall: wall_deg is measured, with this
  /// error.
  std::optional<double> wall_error_deg;
  double assumed_wall_deg = 0;  ///< without the second turn
  bool complete() const;        ///< all three beams were measured
};

/// wall_deg: the heading of the samples at which the body is believed to face the wall squarely. If the body
/// turned at two places, 0.1 m or more apart along the wall, their distances from the wall say better.
/// Readings at other places are left out.
Calibration calibrate(const Sweep& sweep, const Params& params, double wall_deg);

/// deg; measured minus believed axis, counter-clockwise positive.
double skew_deg(const Believed& beam, const BeamFit& fit);
/// deg; L from the measured cone.
double incidence_deg(const BeamFit& fit);
double incidence_error_deg(const BeamFit& fit);
/// deg; L if the cone is as wide as believed.
double incidence_deg(const BeamFit& fit, const Believed& beam);

/// One line: why this beam could not be measured, and what to do.
std::string trouble_words(const Believed& beam, const BeamFit& fit);

/// What follows from the measured beams.
struct Advice {
  std::vector<std::string> lines;  ///< "key = value" for the robot file
  std::vector<std::string> notes;  ///< for people; the first lines are of parameters that do not fit together
  Params params;                   ///< with the lines; only if they fit together
  bool fits = true;                ///< check() accepts them
};

/// The lines are rounded to the safe side: an incidence that is certainly heard, a cone that is certainly
/// covered. params must pass check().
Advice advise(const Calibration& calibration, const Params& params);

}  // namespace whisker::calibration

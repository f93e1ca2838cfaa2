/// Input of the calibration: what three rangefinders read while the robot turns on the spot.
#pragma once

#include <array>
#include <vector>

#include "firmware/params.hpp"
#include "hal/types.hpp"

namespace whisker::calibration {

enum class Reading {
  echo,   ///< at a distance; one below the minimum range counts as an echo there
  clear,  ///< no echo within the maximum range
  lost,   ///< the sensor gave nothing
};

/// One measurement of one beam.
struct Sample {
  double heading_rad = 0;  ///< of the body by odometry when the distance was true; unbounded
  Reading reading = Reading::lost;
  double metres = 0;        ///< of an echo
  double x_m = 0, y_m = 0;  ///< of the body by odometry
};

/// Each measurement once, in the order in which they were taken.
using Samples = std::vector<Sample>;
using Sweep = std::array<Samples, hal::kBeams>;

/// What the parameters say of one beam: degrees and metres, in the frame of the body.
struct Believed {
  double axis_deg = 0;  ///< from straight ahead, counter-clockwise positive, -180 to 180
  double half_cone_deg = 0;
  double x_m = 0;  ///< of the apex
  double y_m = 0;
  double min_range_m = 0;
  double max_range_m = 0;
};

Believed believed(const Params& params, int beam);

/// A reading of the HAL. A stale one is none: false.
bool sample_of(const hal::RangeReading& reading, const Believed& beam, Sample& sample);

}  // namespace whisker::calibration

/// Input of the calibration: what three rangefinders read while the robot turns on the spot.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "firmware/math/trig.hpp"
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

/// Makes samples of the readings of successive ticks: each measurement once, with the heading at its time.
class Collector {
 public:
  explicit Collector(const Params& params);

  /// t_s: of the tick, rising. pose: by odometry. Takes the readings with a new sequence number and a known
  /// age.
  void add(double t_s, const Pose& pose, const hal::RangeReadings& readings);
  /// rad, since the first tick.
  double turned_rad() const { return path_.empty() ? 0 : path_.back().heading - start_; }
  /// m, of the last tick from the first.
  double from_start_m() const;
  const Sweep& sweep() const { return sweep_; }

 private:
  struct Moment {
    double t_s;
    double heading;  // rad, unbounded
  };
  /// False: older than what is kept.
  bool heading_at(double t_s, double& heading) const;

  std::array<Believed, hal::kBeams> beams_;
  std::array<std::optional<std::uint8_t>, hal::kBeams> sequence_;
  std::deque<Moment> path_;
  Pose first_, last_;
  double start_ = 0;
  Sweep sweep_;
};

}  // namespace whisker::calibration

#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "firmware/math/trig.hpp"
#include "host/calibration/sample.hpp"

namespace whisker::calibration {

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

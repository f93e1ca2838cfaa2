/// The three rangefinders: measurement times, ranges, faults and latency.
#pragma once

#include <stdint.h>

#include "hal/types.hpp"
#include "host/harness/sim/cone.hpp"
#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/random.hpp"
#include "host/harness/sim/spec.hpp"
#include "host/harness/sim/world.hpp"

namespace whisker::sim {

/// All three take measurement k at k / rate (to the nearest microsecond); it arrives `latency` later.
///
/// A distance is that of the nearest echo in the beam's own cone or, with the crosstalk probability, in a
/// neighbouring one where that is nearer; then it is scaled. Without an echo within max_range it becomes,
/// with the cover glass's probability, the distance of the glass, else with the phantom probability one of
/// 0.1 to 0.5 m.
///
/// The first condition that holds decides: lost with the dropout probability (invalid); wrongly clear with
/// the false-clear probability; without an echo within max_range, invalid if something there is too dark and
/// dark_is_invalid, else clear; else the distance, folded back below the minimum if near_is_farther, plus
/// noise, which may make it clear or too_near, rounded to the nearest millimetre. Each measurement draws the
/// same count of random numbers, whatever the outcome. Before the first arrival: stale, age 255, sequence 15.
class RangeSensors {
 public:
  RangeSensors(const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed);

  /// Time of the next measurement, microseconds from the start.
  int64_t due_us() const { return due_us_; }
  /// Takes the measurement that is due at due_us(), from this pose.
  void measure(const WorldView& world, const Pose& pose);
  /// The newest measurement that has arrived at this time, microseconds; not before the last measure().
  hal::RangeReadings read(int64_t now_us) const;

 private:
  struct Faults {
    Random noise;
    Random dropout;
    Random false_clear;
    Random phantom;
    Random crosstalk;
    Random cover_glass;
    Faults(uint64_t seed, uint32_t beam);
  };
  /// The nearest obstacle within this cone that is nearer than the limit, m; else infinite.
  double seen(const Cone& cone, double half_width, const WorldView& world, double t, double limit) const;
  /// The distance that beam i measures, given those in the cones of all beams.
  double echo(int i, const double (&metres)[hal::kBeams]);
  hal::RangeReading classified(int i, double metres, bool dark);
  double sigma(double metres) const;

  static constexpr int64_t kKept = 32;
  struct Measurement {
    int64_t at_us;
    hal::RangeReadings readings;  // age not yet known
  };

  RobotSpec robot_;
  NoiseSpec noise_;
  double interval_us_;
  int64_t latency_us_;
  struct Direction {
    SinCos axis;  // from straight ahead
    SinCos half_width;
    explicit Direction(const BeamSpec& beam)
        : axis(sin_cos(beam.angle)), half_width(sin_cos(beam.cone_half_width)) {}
  };
  Direction directions_[hal::kBeams];
  double sin_incidence_;
  Faults faults_[hal::kBeams];
  int64_t count_ = 0;
  int64_t due_us_ = 0;
  Measurement kept_[kKept] = {};
};

}  // namespace whisker::sim

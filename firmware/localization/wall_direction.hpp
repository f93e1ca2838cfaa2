/// The heading by the walls that the robot drives along.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "hal/types.hpp"

namespace whisker::localization {

/// Where walls are straight and their direction is known (WallParams), a wall passed at a side is a compass.
///
/// The nearest point of such a wall lies on the outer edge of the side beam's cone. While the body drives
/// along it, these points form a line, whose direction in the odometry frame shows how far the heading is
/// off. Means over 60 mm of it must lie on a line; the first and the last one do not count, because near a
/// corner the nearest point lies inside the cone. A line counts if the line before it says the same: other
/// objects form lines, too, but not twice in one direction. Source of the method and its figures:
/// docs/odometry.md.
class WallDirection {
 public:
  /// An echo of a side beam.
  struct Echo {
    Vec at;         ///< on the outer edge of the cone, odometry frame
    Angle heading;  ///< of the body when it was measured
  };
  /// The heading of the odometry is off by `ahead`, at most 15 degrees, with this standard deviation.
  struct Found {
    Angle ahead;
    Angle sigma;
  };

  void restart() noexcept;
  /// The next reading of a side beam; null: it shows no wall. `direction` is that of the walls in the
  /// odometry frame. True: a wall has been passed, and `found` says what it shows.
  bool pass(hal::Beam side, const Echo* echo, Angle direction, Found& found) noexcept;

 private:
  static constexpr int kMeans = 14;
  /// From the origin of its run; 2^6 um.
  struct Place {
    int16_t x = 0;
    int16_t y = 0;
  };
  /// One wall so far.
  struct Run {
    Place means[kMeans];
    Vec origin;
    Vec from;       // of the mean that is being made
    int32_t x = 0;  // sum of its points, from `from`; um
    int32_t y = 0;
    Place last;
    int16_t heading = 0;  // of the body at its beginning; 2^-16 turn
    uint8_t points = 0;
    int8_t count = 0;  // of means
  };
  static void add(Run& run, const Echo& echo) noexcept;
  static Place place(const Run& run, Vec at) noexcept;
  static Vec point(const Run& run, const Place& place) noexcept;
  bool finish(const Run& run, Angle direction, Found& found) noexcept;
  static void drop(Run& run) noexcept {
    run.points = 0;
    run.count = 0;
  }

  Run runs_[2];          // left, right
  Angle earlier_;        // direction of the last line
  Angle earlier_sigma_;  // zero: none yet
};

}  // namespace whisker::localization

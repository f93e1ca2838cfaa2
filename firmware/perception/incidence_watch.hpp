/// Estimates up to which angle from its normal a wall gives an echo.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "hal/types.hpp"

namespace whisker::perception {

/// A reading that shows an object.
struct SeenRange {
  uint16_t mm = 0;  ///< 0: none
  Length scatter;   ///< allowance of RangeScatter
};

/// While the body turns on the spot by D, the distance d of a surface at the incidence i grows by d tan(i) D,
/// whatever the width of the cone. So five readings in a row measure i. The result is the incidence that 98 %
/// of the measurements do not exceed. It is a lower bound: it approaches the limit of the sensor from below
/// if the robot turns past long walls, and stays lower if walls end before they vanish. Three beams cannot
/// tell an end from a loss, because both look alike until the ground behind is seen from elsewhere. It only
/// informs: nothing that the robot does depends on it.
class IncidenceWatch {
 public:
  void reset() noexcept;
  /// Call once per set of readings, in order; `from` is the pose of the body at the measurement.
  void add(const Pose& from, const SeenRange (&seen)[hal::kBeams],
           const Mount (&mounts)[hal::kBeams]) noexcept;
  /// In degrees, rounded down; 0 while there are too few measurements.
  uint8_t seen_deg() const noexcept {
    return measured_ < kEnough ? uint8_t{0} : narrow<uint8_t>((seen_.raw() >> 16) * 360 >> 16);
  }

 private:
  static constexpr uint8_t kEnough = 100;
  void measure(Length distance, Length grows, Angle turned, Length scatter) noexcept;

  Pose from_;  // of the first reading
  uint16_t first_[hal::kBeams] = {};
  uint16_t middle_[hal::kBeams] = {};
  Angle seen_;
  uint8_t count_ = 0;  // readings in a row
  uint8_t measured_ = 0;
};

}  // namespace whisker::perception

/// From raw readings to echoes: one sensor's history, its age, and its health.
#pragma once

#include <stdint.h>

#include "firmware/health.hpp"
#include "firmware/math/angle.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/echo.hpp"
#include "hal/types.hpp"

namespace whisker::perception {

/// What a moving beam tells.
struct RecentReadings {
  bool fresh = false;     ///< a usable measurement came at this tick
  Time taken;             ///< when the newest one was
  Time oldest;            ///< when the oldest of those behind `near` was
  Echo near;              ///< the nearest of the last four: no single reading can make it far
  bool clear = false;     ///< the newest one says that nothing is there
  Echo typical;           ///< the median of the last three
  Length farthest;        ///< of the last three: no single reading can make it near
  bool measured = false;  ///< the last three are all distances of something
  Length bend;            ///< if so, how far the second of them lies off the line through the others, twice
};

/// One beam. Keeps the last usable measurements; a lost one is counted and never stored, so that it
/// can neither stand for "far" nor vote.
class BeamConditioner {
 public:
  static constexpr int kHistory = 5;  ///< the largest ConditioningParams::reads

  /// Takes the reading that the HAL shows at this tick; one already seen (same sequence) only ages.
  /// heading: the body's, to tell a stuck sensor from a quiet world.
  void update(const hal::RangeReading& reading, Time now, Angle heading, const Params& params,
              Health& health) noexcept;
  /// The HAL had nothing to show.
  void miss(Time now, const Params& params, Health& health) noexcept;

  /// The consensus of the measurements taken at or after `since`.
  Echo look(Time since, const Params& params) const noexcept;
  /// Pending until there are enough measurements.
  RecentReadings sight(const Params& params) const noexcept;
  /// The latest measurement by itself, fit for watching, not for planning.
  Echo latest() const noexcept { return latest_; }
  /// How long ago the last usable measurement arrived.
  Duration lost_for(Time now) const noexcept { return now - last_usable_; }
  /// Forgets everything; the beam is pending and, from `now`, not yet lost.
  void reset(Time now) noexcept;

 private:
  struct Measurement {
    Length distance;
    Time taken;
  };
  Validity classify(const hal::RangeReading& reading, Angle heading, const Params& params,
                    Health& health) noexcept;
  bool is_stuck(const hal::RangeReading& reading, Angle heading, Angle stuck_turn) noexcept;
  void age(Time now, const Params& params, Health& health) noexcept;

  Measurement history_[kHistory];
  int8_t count_ = 0;
  int8_t newest_ = 0;
  Echo latest_;
  bool fresh_ = false;
  Time last_new_;
  Time last_usable_;
  uint16_t repeated_mm_ = 0;
  bool repeating_ = false;
  Angle repeated_since_;
  uint8_t sequence_ = 0xFF;
};

class RangeConditioner {
 public:
  void reset(Time now) noexcept;
  /// readings == nullptr: the HAL refused.
  void update(const hal::RangeReadings* readings, Time now, Angle heading, const Params& params,
              Health& health) noexcept;
  Echoes look(Time since, const Params& params) const noexcept;
  RecentReadings sight(int beam, const Params& params) const noexcept { return beam_[beam].sight(params); }
  Echoes latest() const noexcept;
  /// The longest time for which some beam has had no usable measurement.
  Duration lost_for(Time now) const noexcept;

 private:
  BeamConditioner beam_[hal::kBeams];
};

}  // namespace whisker::perception

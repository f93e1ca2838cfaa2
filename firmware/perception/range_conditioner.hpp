/// From raw readings to echoes: history, age and health of each sensor.
#pragma once

#include <stdint.h>

#include "firmware/health.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/echo.hpp"
#include "firmware/perception/repetition.hpp"
#include "hal/types.hpp"

namespace whisker::perception {

/// Readings of a beam while the body moves. Without a fresh one, only `typical`, `phantoms` and `misses` are
/// there.
struct RecentReadings {
  bool fresh = false;   ///< a usable measurement arrived at this tick, and the others confirm what they show
  Time taken;           ///< time of the newest measurement
  Time oldest;          ///< time of the oldest measurement behind `near`
  Echo near;            ///< the nearest of the last four: a single reading cannot make it far. If phantoms
                        ///< are frequent, the nearest of the last five that others confirm
  bool single = false;  ///< the newest measurement alone does not prove `near`: it is clear or a phantom
  bool first_clear = false;  ///< the newest measurement is clear, the one before it is not, and such ones
                             ///< have been false
  bool phantoms = false;     ///< phantoms are frequent
  bool misses = false;       ///< readings that miss an object are frequent
  Echo newest;               ///< the newest measurement
  Echo typical;              ///< the median of the last three
  Length farthest;           ///< the farthest of the last three: a single reading cannot make it near
  bool measured = false;     ///< the last three are all distances
  Length bend;  ///< second difference: if measured, twice the distance of the second one from the line
                ///< through the others
};

/// One beam. Keeps the last usable measurements. A lost one is counted and never stored, so that it neither
/// means "far" nor takes part in the consensus.
class BeamConditioner {
 public:
  static constexpr int kHistory = 5;  ///< readings that are judged together

  /// The beam, a hal::Beam, chooses its own parameters.
  explicit BeamConditioner(int beam = 0) noexcept : beam_(static_cast<int8_t>(beam)) {}

  /// Takes in the reading that the HAL returns at this tick; a known one (same sequence) only ages. How the
  /// body moves tells a stuck sensor from a static world.
  void update(const hal::RangeReading& reading, Time now, const Pose& body, const Params& params,
              Health& health) noexcept;
  /// The HAL returned nothing.
  void miss(Time now, const Params& params, Health& health) noexcept;

  /// The consensus of the measurements taken at or after `since`.
  Echo look(Time since, const Params& params) const noexcept;
  /// Pending until there are enough measurements.
  RecentReadings sight(const Params& params) const noexcept;
  /// The latest single measurement, for display, not for planning.
  Echo latest() const noexcept { return latest_; }
  /// Time since the last usable measurement arrived.
  Duration lost_for(Time now) const noexcept { return now - last_usable_; }
  /// Share of near echoes among four readings with room, and of clear readings between two echoes of one
  /// object, 2^-16. Estimates of the probability of a phantom and of a false clear reading.
  uint16_t phantom_share() const noexcept { return phantoms_; }
  uint16_t false_clear_share() const noexcept { return false_clear_share_; }
  /// Clears the history; the beam is pending and, from `now`, not yet lost.
  void reset(Time now) noexcept;
  /// The pose jumps: repetitions before it mean nothing.
  void put_down() noexcept { repetition_.end(); }

 private:
  struct Measurement {
    Length distance;
    Time taken;
  };
  /// The measurement this many before the newest; below kHistory.
  [[gnu::noinline]] Length distance(int back) const noexcept;
  const Measurement& recent(int back) const noexcept {
    const int place = newest_ - back;
    return history_[place < 0 ? place + kHistory : place];
  }
  Validity classify(const hal::RangeReading& reading, const Pose& body, const Params& params,
                    Health& health) noexcept;
  bool is_stuck(const hal::RangeReading& reading, const Pose& body, const Params& params) noexcept;
  /// Estimates how many readings are wrong.
  void judge(Angle turned, const Params& params) noexcept;
  /// The nearest distance that enough of these readings confirm, or nothing nearer than `far`. Undecided if
  /// fewer agree on an echo, or nearly all disagree.
  Length confirmed(const Length (&last)[kHistory], Length far) const noexcept;
  void age(Time now, const Params& params, Health& health) noexcept;

  int8_t beam_;
  Measurement history_[kHistory];
  int8_t count_ = 0;
  int8_t newest_ = 0;
  Echo latest_;
  bool fresh_ = false;
  Time last_new_;
  Time last_usable_;
  Repetition repetition_;
  uint8_t sequence_ = 0xFF;
  Angle heading_;          // at the last usable reading
  int8_t steady_ = 0;      // readings since a fast turn
  uint16_t phantoms_ = 0;  // share of single near readings, and of single far ones, 2^-16
  uint16_t misses_ = 0;
  uint16_t false_clear_share_ = 0;
};

class RangeConditioner {
 public:
  void reset(Time now) noexcept;
  /// readings == nullptr: the HAL refused.
  void update(const hal::RangeReadings* readings, Time now, const Pose& body, const Params& params,
              Health& health) noexcept;
  void put_down() noexcept;
  Echoes look(Time since, const Params& params) const noexcept;
  RecentReadings sight(int beam, const Params& params) const noexcept { return beam_[beam].sight(params); }
  Echoes latest() const noexcept;
  /// The longest time for which a beam has had no usable measurement.
  Duration lost_for(Time now) const noexcept;
  /// The largest shares of the beams.
  uint16_t phantom_share() const noexcept;
  uint16_t false_clear_share() const noexcept;

 private:
  BeamConditioner beam_[hal::kBeams] = {BeamConditioner{hal::kLeft}, BeamConditioner{hal::kFront},
                                        BeamConditioner{hal::kRight}};
};

}  // namespace whisker::perception

/// From range readings to knowledge of the surroundings.
#pragma once

#include <stdint.h>

#include "firmware/health.hpp"
#include "firmware/localization/pose_history.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/approach_watch.hpp"
#include "firmware/perception/contacts.hpp"
#include "firmware/perception/contradiction.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/perception/motion_detector.hpp"
#include "firmware/perception/percept.hpp"
#include "firmware/perception/range_conditioner.hpp"
#include "firmware/perception/range_monitor.hpp"
#include "firmware/perception/range_scatter.hpp"
#include "hal/types.hpp"

namespace whisker::perception {

/// The pose of the body at a tick, and since when it stands.
struct Standing {
  Pose pose;
  Time now;
  bool settled = false;
  Time settled_since;
};

/// The second stage: conditions the readings and updates the local grid.
class Perception {
 public:
  void configure(const Params& params) noexcept;
  /// No reading has arrived yet; the wait for readings starts at `now`.
  void start(Time now) noexcept { conditioner_.reset(now); }
  /// Resets all cells except those under the body to unknown: it was put down here, or its pose may be wrong.
  void forget(const Pose& pose) noexcept;
  /// The body moves untracked between the last tick and the next one.
  void lose_history() noexcept { history_.reset(); }

  /// Takes in the readings of a tick. readings == nullptr: the HAL refused.
  void sense(const hal::RangeReadings* readings, Time now, const Pose& body, const Params& params,
             Health& health) noexcept;
  /// A body with this pose touches something with these switches: see Contacts::add().
  void touch(uint8_t pressed, const Pose& body) noexcept { contacts_.add(pressed, body); }
  /// Updates the grid and returns the percept; call once per tick after sense().
  void observe(const Standing& body, const Params& params, Percept& out) noexcept;

  /// Between observe() and the planner. A tick that takes readings in has enough to do: what they show is
  /// thought over in the next tick; where each tick brings some, in every second one.
  void put_off(Percept& out) noexcept;

  /// See LocalGrid::open_lane().
  void open_lane(const Pose& from) noexcept { local_grid_.open_lane(from); }

  /// See LocalGrid::vouch(); the body stands. Until it has left, every echo takes back the cells that it may
  /// come from. False: some beam has no usable reading yet.
  bool vouch(Length radius, const Pose& body) noexcept;

  /// The latest single reading of each beam.
  Echoes latest() const noexcept { return conditioner_.latest(); }
  /// The longest time for which a beam has had no usable reading.
  Duration lost_for(Time now) const noexcept { return conditioner_.lost_for(now); }
  /// Clear ground may hold an obstacle, by the parameters or by what the readings show.
  bool doubts() const noexcept {
    return loses_walls_ || misses_ || contradicted_ >= kDistrusted || monitor_.contradicted();
  }
  /// Some beam often shows a phantom, or clear where something is: it takes several readings until an echo
  /// counts.
  bool readings_err() const noexcept { return readings_err_; }
  /// The readings contradict the parameters on which speeds rest.
  bool slows() const noexcept { return monitor_.slows(); }
  /// How far the rangefinders do what the parameters say.
  const RangeTrust& trust() const noexcept { return monitor_.trust(); }
  const LocalGrid& local_grid() const noexcept { return local_grid_; }

 private:
  /// What a beam has shown at this tick, besides its observation.
  struct Shown {
    Length echo_ends;       ///< an echo comes from between the free distance and this
    Length moved;           ///< something moves, nearer than this; zero: nothing does
    SeenRange range;        ///< of the newest reading
    bool appears = false;   ///< nearer than the reading before: another object
    bool too_near = false;  ///< the newest reading
  };
  struct Intake;

  void take_in(int i, Intake& in) noexcept;
  void measure(int i, const RecentReadings& sight, Intake& in) noexcept;
  Length moved(const ConeObservation& observation, const RecentReadings& sight, bool misaimed) noexcept;
  bool mark(const ConeObservation& observation, const RecentReadings& sight) noexcept;
  void revoke(const ConeObservation& echo, const Shown& shown, Vec body) noexcept;
  void doubt(const ConeObservation& echo, Length farthest, Vec body, Mover& mover) noexcept;
  void learn(const Intake& in) noexcept;
  void leave_vouched(Vec body) noexcept;
  bool takes_back(Vec body) noexcept;
  /// From this number of contradictions on, clear ground is not trusted. An object that moves causes fewer.
  static constexpr uint8_t kDistrusted = 6;
  /// From this number on, the beams may point beside their axes; from twice as many on, that does not explain
  /// them.
  static constexpr uint8_t kMisaimed = 2;

  Mount mounts_[hal::kBeams];
  bool loses_walls_ = false;  // by the parameters, a clear cell may hold a wall
  bool misses_ = false;       // some beam often reports clear where something is
  bool readings_err_ = false;
  uint8_t contradicted_ = 0;  // echoes from clear ground that nothing moving explains
  Contradiction contradictions_[hal::kBeams];
  ApproachWatch approaches_[hal::kBeams];
  uint8_t taken_back_ = 0;  // echoes that appeared and took back ground, near the place below
  Vec taken_back_at_;
  uint8_t seen_ = 0;                      // one bit per beam that has a last reading
  EarlierObservation last_[hal::kBeams];  // of each beam, if any: see mark()
  bool waits_ = false;                    // readings that nobody has thought over
  uint8_t put_off_ = 0;                   // one bit per beam with such an observation
  uint8_t put_off_hits_ = 0;              // of them, those with an object
  RangeScatter scatter_[hal::kBeams];
  RangeConditioner conditioner_;
  localization::PoseHistory history_;
  MotionDetector motion_;
  RangeMonitor monitor_;
  Contacts contacts_;
  LocalGrid local_grid_;
  struct Vouched {
    bool any = false;
    Vec at;
  };
  Vouched vouched_;
};

}  // namespace whisker::perception

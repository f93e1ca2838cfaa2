/// The planner's interface: its inputs and its decision in a tick.
#pragma once

#include <stdint.h>

#include "firmware/fuzzy/variables.hpp"
#include "firmware/localization/odometry.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/perception/lane.hpp"
#include "firmware/perception/percept.hpp"
#include "firmware/planning/manoeuvre.hpp"
#include "firmware/planning/state.hpp"
#include "hal/types.hpp"

namespace whisker::planning {

struct Goal {
  Vec at;
  Length tolerance;
  friend constexpr bool operator==(const Goal& a, const Goal& b) noexcept {
    return a.at.x == b.at.x && a.at.y == b.at.y && a.tolerance == b.tolerance;
  }
};

/// What only a planner of a calibration needs: the readings as they are.
struct RawReadings {
  localization::CountStep counts;  ///< of this tick
  hal::RangeReadings ranges{};
  bool by_gyro = false;  ///< the gyro turns the pose
};

/// The inputs of a planner in a tick.
struct View : perception::Percept {
  Pose pose{};                ///< the body's estimate
  uint32_t travelled_um = 0;  ///< path length so far, um modulo 2^32
  Length bound;               ///< localization::distance_bound of the estimate; zero: not known
  bool settled = true;        ///< the last manoeuvre has ended and the body stands
  bool cut = false;    ///< the last manoeuvre was a drive, and the guard or a bump ended it before its length
  Speed forward{};     ///< of the body, by its wheels
  Speed turning{};     ///< of the rims, counter-clockwise positive
  Q14 granted{};       ///< granted part of the last requested forward speed
  Duration elapsed{};  ///< since the previous tick

  RawReadings raw;

  /// The guard granted only part of the request.
  constexpr bool held_back() const noexcept { return granted < Q14::ratio(1, 1); }
};

enum class Outcome : uint8_t { none, running, reached, unreachable, gave_up };

/// From this tick on, there is a lane: see perception::Lane.
struct NewLane {
  bool opens = false;
  Pose from;
};

/// The planner's request and its reason.
struct Decision {
  [[gnu::always_inline]] Decision() noexcept = default;  // see GoalPlanner

  Manoeuvre manoeuvre;  ///< ManoeuvreKind::keep: continue
  Mode mode = Mode::idle;
  Why why = Why::none;
  Outcome outcome = Outcome::none;
  uint8_t danger_count = 0;  ///< the thesis's t: positions since the target direction was last free
  bool looked = false;       ///< this tick's decision used a static scan
  NewLane lane;
  fuzzy::Inputs inputs;  ///< of the response table, as last used
  fuzzy::Response response;
  Angle bend;  ///< by which SA deflects the course, as of the last sensor update; counter-clockwise positive
};

/// A planner is called once per tick, never blocks, and keeps its last mode, reason and outcome until they
/// change. set_goal and cancel may come at any time; the next step() processes them.
class Planner {
 public:
  virtual void set_goal(const Goal& goal) noexcept = 0;
  /// The pose was corrected: the goal is at `at` now. The mission continues.
  virtual void move_goal(Vec at) noexcept = 0;
  virtual void cancel() noexcept = 0;
  virtual Decision step(const View& view) noexcept = 0;
  /// After the command of this tick was sent: with what is left of its time, a planner may go on with what no
  /// command waits for. View::local_grid's work() says how much is left.
  virtual void ponder(const View&) noexcept {}

 protected:
  ~Planner() = default;
};

}  // namespace whisker::planning

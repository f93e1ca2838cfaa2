/// The base with its senses: everything that a robot and a guard have in common.
#pragma once

#include "firmware/control/wheel_drive.hpp"
#include "firmware/health.hpp"
#include "firmware/localization/localizer.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/perception.hpp"
#include "firmware/planning/manoeuvre.hpp"
#include "firmware/safety/pace.hpp"
#include "firmware/safety/speed_limiter.hpp"
#include "firmware/safety/supervisor.hpp"
#include "firmware/safety/warned_speed.hpp"
#include "hal/drive.hpp"
#include "hal/gyro.hpp"
#include "hal/rangefinders.hpp"

namespace whisker {

/// The one path from the counts and readings to the command of the wheels. A tick is, in this order:
///
///   take_time(now)             the clock, checked
///   take_counts()              counts, gyro                         -> pose
///   sense(readings)            readings                             -> their latest consensus
///   observe(settled, ..)       readings, poses                      -> percept, local grid
///   limit(slowed(request))     a request, local grid                -> wheel speeds that touch nothing
///   watch(speeds, counted)     the speeds, counts                   -> faults of the wheels
///   actuate(speeds)            the speeds                           -> hal::Drive
///
/// What decides between observe() and limit(), a planner or an operator, is the owner's. Once a check has
/// failed, faulted() holds until reset(), and the owner requests nothing.
class Chassis {
 public:
  /// All must outlive it. The gyro may be null.
  Chassis(hal::Rangefinders& rangefinders, hal::Drive& drive, hal::Gyro* gyro, const Params& params,
          localization::Estimate& estimate, Health& health) noexcept;
  /// Before everything else, if check() accepts the parameters; otherwise nothing but actuate({}) may follow.
  void configure() noexcept;

  /// The body was put down here: ground beside it is unknown, and the next counts are the new zero.
  void put_down(const Pose& pose) noexcept;
  /// Ends the fault. The time and the readings begin anew.
  void reset() noexcept;
  /// The pose continues after reset() although the body may have moved: the next counts may include the whole
  /// braking path, and ground beside the body is unknown.
  void carry_on() noexcept;
  /// Something else has braked the wheels since the last tick.
  void braked_elsewhere() noexcept { braked_elsewhere_ = true; }

  /// False: it is the first tick since reset().
  bool take_time(Time now) noexcept;
  enum class Counted : uint8_t {
    no,        ///< the drive refused, or the counts jumped
    yes,       ///< the pose is that of the counts
    corrected  ///< also, and the user's frame has moved: so has the goal in the odometry frame
  };
  Counted take_counts() noexcept;
  void sense(hal::RangeReadings& readings) noexcept;
  /// Since when the body stands, if it is settled. Not while faulted.
  void observe(bool settled, Time settled_since, perception::Percept& out) noexcept;

  /// Every beam has a fresh reading.
  bool sees() const noexcept { return perception_.lost_for(last_tick_) <= params_.conditioning.stale_after; }
  /// The wheels may be commanded.
  bool may_drive(bool counted) const noexcept {
    return counted && sees() && !supervisor_.faulted() && !supervisor_.refused();
  }
  /// The request at the pace that the readings allow. `step`: SD of the response table for the ground as it
  /// is now; zero: no table sets a pace.
  planning::VelocityRequest slowed(planning::VelocityRequest request, Q14 step) noexcept;
  WheelPair limit(const planning::VelocityRequest& request) noexcept;
  /// Back over ground that the body has covered just before, unchecked.
  WheelPair retrace(const planning::VelocityRequest& request) noexcept;
  /// The body ran into something, which stops the wheels.
  WheelPair halt() noexcept;
  void watch(WheelPair speeds, bool counted) noexcept;
  /// Returns what was sent; zero if the drive refused.
  hal::WheelSpeeds actuate(WheelPair speeds) noexcept;

  /// What this tick has computed so far, in the units of Work.
  uint16_t work() const noexcept { return perception_.local_grid().work().done(); }

  /// There was a tick since reset().
  bool started() const noexcept { return started_; }
  bool faulted() const noexcept { return supervisor_.faulted(); }
  Time now() const noexcept { return last_tick_; }
  /// Since the last tick, at most the longest gap.
  Duration elapsed() const noexcept { return elapsed_; }
  /// The body in the odometry frame.
  Pose pose() const noexcept { return localizer_.inside(); }
  localization::Localizer& localizer() noexcept { return localizer_; }
  const localization::Localizer& localizer() const noexcept { return localizer_; }
  perception::Perception& perception() noexcept { return perception_; }
  const perception::Perception& perception() const noexcept { return perception_; }
  safety::Supervisor& supervisor() noexcept { return supervisor_; }
  const safety::Supervisor& supervisor() const noexcept { return supervisor_; }
  const safety::SpeedLimiter& limiter() const noexcept { return limiter_; }
  const WheelState& wheels() const noexcept { return wheels_.state(); }
  /// What SD allows straight ahead since slowed(), where it is more than the warned speed; zero: nothing.
  Speed pace() const noexcept { return pace_.now(); }

 private:
  /// Nothing moves, and the readings hardly contradict each other: what no beam shows is not near.
  bool trusts_ground() const noexcept;

  hal::Rangefinders& rangefinders_;
  hal::Gyro* gyro_;
  const Params& params_;

  Time last_tick_;
  Duration elapsed_;
  Duration since_counts_;  // since the counts were last read
  bool started_ = false;
  bool braked_elsewhere_ = false;

  localization::Localizer localizer_;
  control::WheelDrive wheels_;
  safety::SpeedLimiter limiter_;
  safety::WarnedSpeed warned_speed_;
  safety::Pace pace_;
  Length nearest_;
  safety::Supervisor supervisor_;
  perception::Perception perception_;
};

}  // namespace whisker

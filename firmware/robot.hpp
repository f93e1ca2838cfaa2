/// The whole core, once a tick: localize -> perceive -> plan -> guard -> actuate.
#pragma once

#include "firmware/control/wheel_drive.hpp"
#include "firmware/health.hpp"
#include "firmware/localization/frame.hpp"
#include "firmware/localization/odometry.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/perception.hpp"
#include "firmware/planning/motion_controller.hpp"
#include "firmware/planning/planner.hpp"
#include "firmware/safety/guard.hpp"
#include "firmware/safety/supervisor.hpp"
#include "hal/drive.hpp"
#include "hal/rangefinders.hpp"

namespace whisker {

/// What happened in the last tick.
struct Status {
  planning::Decision decision;
  Pose pose;                   ///< estimated
  perception::Echoes echoes;   ///< the latest reading of each beam by itself
  hal::WheelSpeeds command{};  ///< as given to the drive
  Health health;
};

/// One robot. Allocates nothing, waits for nothing; a tick's work is bounded.
///
///   Robot robot{rangefinders, drive, planner, params};
///   robot.place({{0_m, 0_m}, 0_deg});
///   robot.set_goal({{4_m, 1_m}, 100_mm});
///   every 10 ms:  robot.tick(Time::from_raw(clock.now_ms()));
///
/// A failure ends in the safe state: both wheels slow down at the acceleration limit to zero, stay
/// there, and status().health.fault names the cause until reset(). All references must outlive the robot,
/// and the parameters must not change while it lives.
///
/// Places are those of its user, and lie at most kPlaceLimit out (core/region.hpp).
class Robot {
 public:
  Robot(hal::Rangefinders& rangefinders, hal::Drive& drive, planning::Planner& planner,
        const Params& params) noexcept;

  /// Tells the robot where it is.
  ///
  /// Without a goal under way it is put down there: it forgets all ground, and takes the wheels' next counts
  /// as zero. With one, its estimate is corrected: what it knows of the ground stays around the body as it
  /// is, what the wheels are doing goes on, and the goal lies elsewhere from then on. Who carries the robot
  /// away must cancel() before.
  ///
  /// False: nothing was changed: it lies beyond kPlaceLimit, which is a fault.
  bool place(const Pose& pose) noexcept;
  /// Accepted in any state; one given while a fault stands is dropped by reset(). False: it lies beyond
  /// kPlaceLimit, or corrections have moved it there. It is refused with Why::goal_out_of_range, and the
  /// mission under way ends.
  bool set_goal(const planning::Goal& goal) noexcept;
  void cancel() noexcept;
  /// Clears the fault and forgets all readings and all ground but that under the body: the pose goes on from
  /// the estimate, which a fault may have cost some distance. The goal must be set again. Parameters that
  /// check() refused at construction stay refused.
  void reset() noexcept;

  /// Something else has braked the wheels since the last tick, as a bus does that misses messages: the next
  /// gap may be as long as safety.lost_after.
  void braked_elsewhere() noexcept { braked_elsewhere_ = true; }

  /// One control tick. `now` is the time of this tick, about params.safety.period after the last, and at most
  /// longest_gap(params): each command is judged to hold for that long.
  const Status& tick(Time now) noexcept;
  const Status& status() const noexcept { return status_; }

 private:
  // The five stages of a tick, in this order; each is visited once. The view is what is known so far.
  bool localize(Time now, planning::View& view) noexcept;
  void perceive(planning::View& view) noexcept;
  void plan(const planning::View& view) noexcept;
  WheelPair guard(const planning::View& view, bool paused) noexcept;
  void actuate(WheelPair speeds) noexcept;

  void take_time(Time now) noexcept;
  bool take_counts() noexcept;
  void put_down(const Pose& pose) noexcept;
  void correct(const Pose& pose) noexcept;
  void aim_again() noexcept;
  /// Notes whether the goal is within range; without one the planner has nothing to do.
  bool aimed(bool in_range) noexcept;
  void show_fault() noexcept;

  hal::Rangefinders& rangefinders_;
  planning::Planner& planner_;
  const Params& params_;

  Status status_;
  localization::Odometry odometry_;
  localization::Frame frame_;
  perception::Perception perception_;
  planning::MotionController motion_;
  safety::Guard guard_;
  safety::Supervisor supervisor_;
  control::WheelDrive wheels_;

  localization::CountStep step_;  // of this tick
  Time last_tick_;
  Time settled_since_;
  Duration elapsed_;       // since the tick before, at most the longest gap
  Duration since_counts_;  // since the counts were last read
  bool started_ = false;
  bool has_goal_ = false;  // under way
  bool goal_refused_ = false;
  bool was_settled_ = false;
  bool braked_elsewhere_ = false;
};

}  // namespace whisker

/// The complete core. Each tick: localize -> perceive -> plan -> guard -> actuate.
#pragma once

#include "firmware/chassis.hpp"
#include "firmware/health.hpp"
#include "firmware/localization/wall_direction.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/part.hpp"
#include "firmware/planning/goal_planner.hpp"
#include "firmware/planning/motion_controller.hpp"
#include "firmware/planning/planner.hpp"
#include "firmware/safety/bump_reflex.hpp"
#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/gyro.hpp"
#include "hal/rangefinders.hpp"

namespace whisker {

/// The result of the last tick.
struct Status : localization::Estimate {
  planning::Decision decision;
  perception::Echoes echoes;   ///< the latest single reading of each beam
  hal::WheelSpeeds command{};  ///< as sent to the drive
  Speed pace;                  ///< that SD of the response table sets straight ahead; zero: it sets none
  uint8_t pressed = 0;         ///< bump switches, see hal::BumperReading; 0 without a bumper
  uint16_t work = 0;           ///< of this tick, in the units of Work
  uint16_t most_work = 0;      ///< of any tick so far
  Health health;
};

/// One robot. It never allocates or waits, and the work of a tick is bounded.
///
///   Robot robot{rangefinders, drive, planner, params};
///   robot.place({{0_m, 0_m}, 0_deg});
///   robot.set_goal({{4_m, 1_m}, 100_mm});
///   every 10 ms:  robot.tick(Time::from_raw(clock.now_ms()));
///
/// A failure leads to the safe state: both wheels ramp down to zero at the acceleration limit and stand, and
/// status().health.fault names the cause until reset(). All references must outlive the robot, and the
/// parameters must not change while it lives. With parameters that check() refuses, nothing is computed: the
/// planner is never asked, each tick commands zero, and place(), correct() and set_goal() return false.
///
/// A bumper is used if BumperParams::fitted says so: then it must be given. A press stops the wheels at that
/// very tick, the body backs off (safety/bump_reflex.hpp), and the place becomes an obstacle
/// (perception/contacts.hpp). The planner is not asked meanwhile.
///
/// A gyro is used if GyroParams::fitted says so. Its bias is measured whenever the robot stands. During a
/// mission, the robot stands for two seconds at the start and for one about every minute, with
/// Why::gyro_rest; with a declared error of the wheels, for three about every 30 seconds once the heading may
/// be off (localization/gyro_bias.hpp). Without an answer from the gyro, the wheels turn the pose:
/// Status::heading_source, Health::gyro_lost.
///
/// If PoseErrorParams declare an error of the wheels, Status::sigma says how far the pose may be off. It
/// makes clear ground expire sooner (perception/ground_age.hpp) and widens what counts as the same place
/// (planning/boundary/loop_detector.hpp).
///
/// Poses and goals are in the user's frame and lie within kPlaceLimit (math/region.hpp).
class Robot {
 public:
  Robot(hal::Rangefinders& rangefinders, hal::Drive& drive, planning::Planner& planner, const Params& params,
        hal::Bumper* bumper = nullptr, hal::Gyro* gyro = nullptr) noexcept;

  /// Sets the pose of the robot.
  ///
  /// Without an active goal, the robot was put down there: it resets the local grid to unknown, and the next
  /// encoder counts are the new zero. With an active goal, the pose estimate is corrected: at the counts of
  /// the last tick, the body was there. The local grid stays around the body, the current movement continues,
  /// and the goal moves relative to the body. Call cancel() before you carry the robot.
  ///
  /// False: the pose lies beyond kPlaceLimit, which is a fault; nothing else changed.
  bool place(const Pose& pose) noexcept;
  /// A fix: a pose measured outside, by a beacon, a camera or a dock, with its standard deviations. It is the
  /// pose at the counts of the last tick, so call this after tick(). Local grid, map and movement stay, in
  /// the frame of the odometry; the goal moves in it. However wrong a fix is, it does not move ground that
  /// was seen around the body. With Status::sigma, the estimate becomes the mean of both, weighted by their
  /// variances, and a fix that jumps (localization/pose_fix.hpp) is counted as Health::fix_jumps and, if
  /// Params::fix_jumps says so, refused. Without, the estimate becomes the fix. Without a gyro, but with a
  /// declared error of the wheels, the headings of fixes also teach how the wheels turn the body
  /// (localization/fix_teacher.hpp). place() and reset() make the next fix the first one, which teaches
  /// nothing.
  ///
  /// False: it is refused, or lies beyond kPlaceLimit, which is a fault; nothing else changed.
  bool correct(const Pose& pose, const localization::PoseSigma& sigma) noexcept;
  /// Accepted in any state; reset() drops a goal that was set during a fault. False: the goal is refused, and
  /// the current mission ends. The reason is Why::goal_out_of_range if the goal lies beyond kPlaceLimit, or
  /// corrections have moved it there, and Why::tolerance_too_small if its tolerance is below
  /// planning::smallest_tolerance().
  ///
  /// That is enough for the last step, not for any way: even ideal wheels leave the body beside its estimate
  /// by up to two encoder counts / track x the way driven, 2.9 mm per metre for the reference robot, and an
  /// eighth of the tolerance is reserved for it.
  bool set_goal(const planning::Goal& goal) noexcept;
  void cancel() noexcept;
  /// Ends the fault, drops all readings, and resets all ground except that under the body to unknown. The
  /// pose continues from the estimate, which a fault may have made less accurate. The goal must be set again.
  /// Parameters that check() refused at construction stay refused.
  void reset() noexcept;

  /// Something else has braked the wheels since the last tick, for example a bus that lost messages: the next
  /// gap may be as long as derived::lost_after().
  void braked_elsewhere() noexcept { chassis_.braked_elsewhere(); }

  /// One control tick. `now` is about params.safety.period after the last tick and at most
  /// longest_gap(params), because the guard assumes that each command holds for that long.
  const Status& tick(Time now) noexcept;
  const Status& status() const noexcept { return status_; }

 private:
  // The five stages of a tick, in this order, each with its parts. The view collects their results.
  bool localize(Time now, planning::View& view) noexcept;
  void perceive(planning::View& view, bool counted) noexcept;
  void follow_wall(hal::Beam side, const perception::Percept& percept) noexcept;
  void take_bumps(const Pose& pose, bool counted) noexcept;
  void plan(const planning::View& view) noexcept;
  void ask_planner(const planning::View& view) noexcept;
  bool rests_for_gyro() noexcept;
  WheelPair guard(const Pose& pose, bool counted) noexcept;
  WheelPair granted(const Pose& pose, bool may_drive) noexcept;
  void actuate(WheelPair speeds) noexcept;
  void ponder(const planning::View& view) noexcept;
  void show_fault() noexcept;

  bool placeable(const Pose& pose) noexcept;
  void aim_again() noexcept;
  bool unfit() const noexcept { return status_.health.fault == Fault::invalid_params; }
  /// Notes why the goal is refused, or that it is not; without one the planner has nothing to do.
  bool aimed(planning::Why refused) noexcept;

  planning::Planner& planner_;
  const Params& params_;
  hal::Bumper* bumper_;

  Time settled_since_;
  Time waits_since_;       // for a look: since then it stands and no search has run out of time
  Duration resting_for_;   // for the gyro
  bool has_goal_ = false;  // a mission is active
  bool was_settled_ = false;
  planning::Why refused_ = planning::Why::none;  // the last goal

  Status status_;
  Part<localization::WallDirection, kGyroBuilt> walls_;
  safety::BumpReflex reflex_;
  planning::MotionController motion_;
  Chassis chassis_;
};

}  // namespace whisker

/// The guard alone, without a planner: any velocity command in, safe wheel speeds out.
#pragma once

#include <stdint.h>

#include "firmware/chassis.hpp"
#include "firmware/health.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/safety/assist.hpp"
#include "firmware/safety/nod.hpp"
#include "hal/drive.hpp"
#include "hal/gyro.hpp"
#include "hal/rangefinders.hpp"

namespace whisker {

/// A velocity of the body, as a ROS cmd_vel, a joystick or a planner asks for it.
struct Velocity {
  Speed forward;        ///< negative: backwards
  AngularRate turning;  ///< counter-clockwise positive
};

/// Why the wheels do what they do. If several apply, the first of this order after `clear`.
enum class GuardReason : uint8_t {
  clear,            ///< the command is granted in full
  fault,            ///< Health::fault says which; the wheels stand until reset()
  stale_ranges,     ///< a beam has no fresh reading
  command_timeout,  ///< no command yet, or the last one is too old
  nodding,          ///< a beam turns onto unseen ground, or back
  obstacle,         ///< ground near an echo is in the way
  unseen,           ///< ground that no beam has shown to be free is in the way
  doubt,            ///< slower, because the readings or the sensors leave doubt about clear ground
  limits,           ///< the command exceeds what the wheels can do
  assisted,         ///< the response table bends or slows it, and nothing else holds the body back
};
constexpr int kGuardReasons = 10;
const char* name(GuardReason reason) noexcept;

/// The result of the last tick.
struct GuardStatus : localization::Estimate {
  Velocity asked;  ///< the last command; zero after its time-out
  Q14 forward;     ///< granted share of the asked forward speed, 0 to 1
  Q14 turning;     ///< the same of the turning; 0 while the guard nods, or turns the other way to assist
  GuardReason reason = GuardReason::command_timeout;
  hal::WheelSpeeds command{};  ///< as sent to the drive
  Health health;
};

/// Guards whoever commands. It never allocates or waits, and the work of a tick is bounded.
///
///   Guard guard{rangefinders, drive, params};
///   whenever a command arrives:  guard.command({200_mm_per_s, 500_mrad_per_s}, now);
///   every 10 ms:                 guard.tick(now);
///
/// The moving body touches no obstacle that stands still, whatever the commands, if the conditions of
/// docs/safety.md hold. Only the forward speed is scaled, so that the body follows the asked turning. A turn
/// on the spot is always granted: the body is round. If ground that no beam has seen holds the body, and
/// GuardParams::nods says so, a beam is turned onto it (safety/nod.hpp). If GuardParams::assist says so, the
/// response table bends and slows commands near obstacles before they are judged (safety/assist.hpp); the
/// promise does not rest on it.
///
/// All references must outlive the guard, and the parameters must not change while it lives. A bumper is not
/// used: parameters with a creep speed are refused. The pose begins at zero.
class Guard {
 public:
  Guard(hal::Rangefinders& rangefinders, hal::Drive& drive, const Params& params,
        hal::Gyro* gyro = nullptr) noexcept;

  /// Replaces the command; `now` by the clock of tick(). It holds for GuardParams::command_timeout. Any value
  /// is safe: what the wheels cannot do is scaled down.
  void command(const Velocity& velocity, Time now) noexcept;
  /// The operator says that nothing stands within this distance of the body's centre. It counts for ground
  /// that no beam covers, once the readings of all beams have arrived, if the body still stands where it was
  /// said.
  void vouch(Length radius) noexcept;
  /// Another response table for GuardParams::assist than the core's own. It must outlive the guard.
  void assist_by(const fuzzy::Bilinear::Table& table) noexcept { assist_.use(table); }
  /// Ends the fault, drops the command and all readings, and resets all ground except that under the body to
  /// unknown; the pose begins at zero again. Parameters that check() refused stay refused.
  void reset() noexcept;

  /// Something else has braked the wheels since the last tick, for example a bus that lost messages: the next
  /// gap may be as long as derived::lost_after().
  void braked_elsewhere() noexcept { chassis_.braked_elsewhere(); }

  /// One control tick. `now` is about params.safety.period after the last tick and at most
  /// longest_gap(params), because the guard assumes that each command holds for that long.
  const GuardStatus& tick(Time now) noexcept;
  const GuardStatus& status() const noexcept { return status_; }
  const perception::LocalGrid& local_grid() const noexcept { return chassis_.perception().local_grid(); }

 private:
  bool usable() const noexcept;
  void put_down() noexcept;
  void perceive() noexcept;
  void take_command() noexcept;
  planning::VelocityRequest request() const noexcept;
  WheelPair limit_speed(bool counted) noexcept;
  WheelPair target(const planning::VelocityRequest& limited) const noexcept;
  GuardReason held_by(const planning::VelocityRequest& asked, bool doubted) const noexcept;
  bool assists() const noexcept { return params_.guard.assist == Fitted::yes; }
  bool nodding() const noexcept { return nod_.active(); }

  const Params& params_;

  Time commanded_at_;
  Velocity command_;
  Speed fastest_on_the_spot_;  // of the rims
  Length vouched_;             // radius; zero: nothing
  Vec vouched_at_;
  bool commanded_ = false;

  GuardStatus status_;
  safety::Assist assist_;
  safety::Nod nod_;
  Chassis chassis_;
};

}  // namespace whisker

/// Detects, counts and names failures.
#pragma once

#include <stdint.h>

#include "firmware/health.hpp"
#include "firmware/localization/odometry.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/motion_controller.hpp"
#include "firmware/safety/refusals.hpp"
#include "firmware/safety/stall_watch.hpp"
#include "firmware/safety/wheel_watch.hpp"

namespace whisker::safety {

/// Each function checks one condition per tick. The first failure stays in Health::fault until reset(); while
/// a fault is set, the robot brakes and stands.
class Supervisor {
 public:
  /// Both must outlive it.
  Supervisor(const Params& params, Health& health) noexcept : params_(params), health_(health) {}
  void configure() noexcept;
  /// Clears the fault. The wheels may still execute the last command before it.
  void reset() noexcept;

  Health& health() noexcept { return health_; }
  bool faulted() const noexcept { return health_.fault != Fault::none; }
  void fail(Fault fault, uint32_t& counter) noexcept;
  void fail(Fault fault) noexcept;

  /// The time since the last tick. `excused`: something else has braked the wheels meanwhile.
  void check_gap(Duration gap, bool excused) noexcept;
  /// Whether the drive returned counts.
  void check_counts(bool read) noexcept;
  /// The wheels have turned at these speeds for `elapsed` out of `gap`, the time since the last tick.
  void expect_wheels(WheelPair speeds, Duration elapsed, Duration gap) noexcept;
  void check_wheels(const localization::CountStep& step) noexcept;
  /// How long a beam has had no usable reading.
  void check_ranges(Duration lost) noexcept;
  void check_trust(RangeLevel level) noexcept;
  /// How long the body has stood for a static scan that waits.
  void check_look(bool waits, Duration stood) noexcept;
  /// The body has been in one place for too long, whatever the planner waits for or tries. Once per tick.
  bool overstays(Vec at, bool running, Duration elapsed) noexcept;
  /// Whether the bumper gave its state.
  void check_bumper(bool read) noexcept;
  /// A bump switch was pressed here. Bounds the presses near one place in a mission.
  void check_bump(Vec at) noexcept;
  /// See StallWatch::stalled().
  void check_stall(const localization::CountStep& counts, bool commanded, WheelPair rolling,
                   Duration elapsed) noexcept;
  void check_motion(const planning::MotionController& motion) noexcept;
  /// Whether the drive accepted the command.
  void check_command(bool taken) noexcept;
  /// The drive refused the last command.
  bool refused() const noexcept { return drive_refusals_.refused(); }

 private:
  const Params& params_;
  Health& health_;
  Refusals drive_refusals_;
  Refusals encoder_refusals_;
  Refusals bumper_refusals_;
  WheelWatch wheel_watch_;
  StallWatch stall_watch_;
  int16_t unwatched_ms_ = 0;  // time until the wheel watch starts
  int8_t bumps_ = 0;          // near bumped_at_
  Vec place_;                 // the place that the body has not left
  Duration at_place_for_;
  Duration longest_stay_;
  Duration longest_wait_;
  Vec bumped_at_;
};

/// Time to brake from full speed, including the motor lag.
Duration braking_time(const Params& params) noexcept;

}  // namespace whisker::safety

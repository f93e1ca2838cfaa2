/// Turns the current manoeuvre into velocities, tick by tick.
#pragma once

#include <stdint.h>

#include "firmware/localization/odometry.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/manoeuvre.hpp"

namespace whisker::planning {

/// Braking is part of every tick: the speed never exceeds the speed from which the acceleration limit and the
/// motor's lag allow a stop in the remaining distance.
class MotionController {
 public:
  void configure(const Params& params) noexcept;
  /// Starts a manoeuvre; ManoeuvreKind::keep changes nothing.
  void begin(const Manoeuvre& manoeuvre, const Pose& pose) noexcept;

  /// Something else moves the wheels now. A drive ends: see cut(). Any other manoeuvre continues after it.
  void interrupt() noexcept;

  /// Once per tick, unless the robot must stand. `elapsed`: since the previous tick; `held_for`: how long the
  /// guard has held the body. A drive held for longer than kHeld ends: see cut().
  VelocityRequest request(const Pose& pose, Duration elapsed, Duration held_for,
                          const Params& params) noexcept;

  /// Once per tick, after request(). counts == nullptr: no counts arrived, so standstill is unproved.
  /// `commanded`: a wheel is commanded to turn.
  void settle(const localization::CountStep* counts, bool commanded, Duration elapsed,
              const Params& params) noexcept;

  /// The manoeuvre is over and the counts have stood still for three periods.
  bool settled() const noexcept { return settled_; }
  /// The guard, or a bump switch, ended the last drive before its length.
  bool cut() const noexcept { return cut_; }
  /// Time, without pauses, since the manoeuvre last came nearer to its end; after its end, time in which the
  /// wheels were commanded to stand but the body moved.
  Duration waiting_for() const noexcept { return waiting_for_; }

 private:
  VelocityRequest cruise() const noexcept;
  VelocityRequest turn(Angle error, Duration elapsed, const Params& params) noexcept;
  VelocityRequest drive(const Pose& pose, Angle error, Duration elapsed, const Params& params) noexcept;
  void approach(Length rest, Duration elapsed) noexcept;

  Speed fastest_turning_;  // of the rim
  Speed fastest_on_the_spot_;
  Manoeuvre current_{ManoeuvreKind::stop, {}, {}, {}, {}};
  Vec origin_;
  bool finished_ = true;
  bool cut_ = false;
  bool settled_ = false;
  Duration still_for_;
  Duration waiting_for_;
  Duration late_;   // the latest of the last ticks, after its period
  Length nearest_;  // smallest remaining distance of this manoeuvre so far
};

}  // namespace whisker::planning

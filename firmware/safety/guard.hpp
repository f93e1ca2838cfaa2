/// Lets through only what ends in a stop on clear ground.
#pragma once

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/manoeuvre.hpp"

namespace whisker::safety {

struct Grant {
  Speed forward;
  Speed turning;
  Q14 factor;  ///< of the forward speed that was asked for; zero where the guard only brakes
};

/// The forward speed of a cruise that may be commanded this tick beside its rim speed of turning: the largest
/// of a few fractions of it whose braking arc, after the longest gap that may pass before the next tick,
/// brings the disc of Reach::guard nowhere nearer to a cell that is not clear. If there is none, both wheels
/// brake in proportion, along the arc that was found free a tick before.
///
/// `elapsed` since the last tick: what the wheels' speeds may change by now.
///
/// Retracing asks for half of what the cells' size and the margin add to the body's radius. What is not clear
/// beside a way that was just driven was no nearer then, and the way back must not end at what was only
/// passed.
Grant guard(const planning::Manoeuvre& cruise, const Pose& pose, const WheelState& wheels,
            const perception::LocalGrid& local_grid, Duration elapsed, const Params& params) noexcept;

}  // namespace whisker::safety

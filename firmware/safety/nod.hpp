/// Turns a beam onto unseen ground that holds the body.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/arrows.hpp"
#include "firmware/planning/manoeuvre.hpp"

namespace whisker::safety {

/// Between the command and the speed limiter, which judges the nod like any other request.
///
/// 1. look: if the limiter holds the body back because of cells ahead that no beam has cleared, it turns that
///    beam onto the nearest one which needs the smallest turn, until all of them are clear or it has looked
///    for long enough;
/// 2. back: to the heading from before, unless the operator turns by itself: one that follows a path does,
/// and
///    it must not be fought.
///
/// Only for forward requests: no beam looks behind the body.
class Nod {
 public:
  void reset() noexcept { *this = Nod{}; }
  /// Call once per tick. `granted`: SpeedLimiter::granted() of the last tick. Returns the request for this
  /// one.
  planning::VelocityRequest step(const planning::VelocityRequest& asked, Q14 granted, const Pose& pose,
                                 const perception::LocalGrid& grid, Duration elapsed,
                                 const Params& params) noexcept;
  /// It turns the body itself.
  bool active() const noexcept { return phase_ != Phase::off; }

 private:
  enum class Phase : uint8_t { off, look, back };
  static constexpr planning::Arrow<Phase> kArrows[] = {
      {Phase::off, Phase::off},  {Phase::off, Phase::look}, {Phase::look, Phase::back},
      {Phase::look, Phase::off}, {Phase::back, Phase::off},
  };
  /// Unseen cells in the way.
  struct Unseen {
    bool any = false;
    bool covered = false;  ///< a beam covers one already
    Angle turn[2];  ///< smallest turn to the left and to the right that brings a beam onto another; or zero
  };
  void enter(Phase phase) noexcept;
  Unseen unseen(const Pose& pose, const perception::LocalGrid& grid, const Params& params) const noexcept;
  bool needed(const planning::VelocityRequest& asked, Q14 granted, const Pose& pose,
              const perception::LocalGrid& grid, Duration elapsed, const Params& params) noexcept;

  bool look(const Pose& pose, const perception::LocalGrid& grid, Duration elapsed, const Params& params,
            Speed& turning) noexcept;
  bool turn_back(const Pose& pose, const Params& params, Speed& turning) noexcept;

  Phase phase_ = Phase::off;
  int8_t tries_ = 0;    // looks one after another that have not cleared the way
  bool right_ = false;  // it turns to the right
  Duration for_;        // in this phase, or held back in Phase::off
  Duration covered_for_;
  Angle heading_;  // before the nod
  Angle last_heading_;
  Angle way_;  // direction of the asked way
};

}  // namespace whisker::safety

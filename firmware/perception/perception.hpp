/// What the robot learns about the ground near it, and how that holds its wheels back.
#pragma once

#include <stdint.h>

#include "firmware/localization/pose_history.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/perception/motion_detector.hpp"
#include "firmware/perception/range_conditioner.hpp"
#include "firmware/perception/range_scatter.hpp"
#include "firmware/planning/planner.hpp"
#include "firmware/safety/guard.hpp"

namespace whisker::perception {

/// Where the body is at a tick, and whether and since when it stands.
struct Standing {
  Pose pose;
  Time now;
  bool settled = false;
  Time settled_since;
};

/// The local grid and what it is made from.
class LocalPerception {
 public:
  using ConeObservations = ConeObservation[hal::kBeams];
  void configure(const Params& params) noexcept;
  void place(const Pose& pose) noexcept;
  /// Nothing is known but the ground under the body: it may not be where it was thought to be.
  void forget(const Pose& pose) noexcept;
  /// Between the last tick and the next one the body moved in a way that nobody followed.
  void lose_history() noexcept { history_.reset(); }
  /// Marks what the beams show at this tick, and fills in what a planner sees of it.
  /// `proofs` must live as long as the view.
  void observe(const Standing& body, const RangeConditioner& conditioner, const Params& params,
               ConeObservations& observations, planning::View& view) noexcept;
  /// Slows a cruise down to what the ground allows; `elapsed` since the last tick.
  void guard(planning::Manoeuvre& manoeuvre, const Pose& pose, const WheelState& wheels, Duration elapsed,
             const Params& params) noexcept;

 private:
  localization::PoseHistory history_;
  LocalGrid local_grid_;
  MotionDetector motion_;
  RangeScatter scatter_[hal::kBeams];
  EarlierObservation last_[hal::kBeams];  // reading of each beam, if it is
  uint8_t seen_ = 0;                      // a bit for each beam that has one
  Q14 granted_;
};

/// Remembers no ground, for a chip with no room for it: 1.1 KB less. The thesis planner needs none; the
/// boundary planner cannot do without.
class NoPerception {
 public:
  struct ConeObservations {};
  void configure(const Params&) noexcept {}
  void place(const Pose&) noexcept {}
  void forget(const Pose&) noexcept {}
  void lose_history() noexcept {}
  void observe(const Standing&, const RangeConditioner&, const Params&, const ConeObservations&,
               planning::View&) noexcept {}
  void guard(planning::Manoeuvre&, const Pose&, const WheelState&, Duration, const Params&) noexcept {}
};

/// The one that the core is built with.
#ifdef WHISKER_SMALL
using Perception = NoPerception;
#else
using Perception = LocalPerception;
#endif

}  // namespace whisker::perception

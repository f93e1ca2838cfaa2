/// What the robot learns about the ground near it, and how that holds its wheels back.
#pragma once

#include <stdint.h>

#include "firmware/core/trig.hpp"
#include "firmware/core/units.hpp"
#include "firmware/ground/patch.hpp"
#include "firmware/ground/witness.hpp"
#include "firmware/motion/history.hpp"
#include "firmware/motion/shield.hpp"
#include "firmware/nav/planner.hpp"
#include "firmware/params.hpp"
#include "firmware/ranges/conditioner.hpp"
#include "firmware/ranges/scatter.hpp"

namespace whisker {

/// Where the body is at a tick, and whether and since when it stands.
struct Standing {
  Pose pose;
  Time now;
  bool settled = false;
  Time settled_since;
};

/// The clearance patch and what it is made from.
class GroundMapper {
 public:
  using Proofs = ground::Proof[hal::kBeams];
  void configure(const Params& params) noexcept;
  void place(const Pose& pose) noexcept;
  /// Nothing is known but the ground under the body: it may not be where it was thought to be.
  void forget(const Pose& pose) noexcept;
  /// Between the last tick and the next one the body moved in a way that nobody followed.
  void lose_history() noexcept { history_.reset(); }
  /// Marks what the beams show at this tick, and fills in what a planner sees of it.
  /// `proofs` must live as long as the view.
  void observe(const Standing& body, const ranges::Conditioner& conditioner, const Params& params,
               Proofs& proofs, nav::View& view) noexcept;
  /// Slows a cruise down to what the ground allows; `elapsed` since the last tick.
  void guard(nav::Manoeuvre& manoeuvre, const Pose& pose, const motion::WheelState& wheels, Duration elapsed,
             const Params& params) noexcept;

 private:
  motion::History history_;
  ground::Patch patch_;
  ground::Witness witness_;
  ranges::Scatter scatter_[hal::kBeams];
  ground::Earlier last_[hal::kBeams];  // reading of each beam, if it is
  uint8_t seen_ = 0;                   // a bit for each beam that has one
  Q14 granted_;
};

/// Remembers no ground, for a chip with no room for it: 1.1 KB less. The thesis planner needs none; the
/// skirt planner cannot do without.
class NoMapper {
 public:
  struct Proofs {};
  void configure(const Params&) noexcept {}
  void place(const Pose&) noexcept {}
  void forget(const Pose&) noexcept {}
  void lose_history() noexcept {}
  void observe(const Standing&, const ranges::Conditioner&, const Params&, const Proofs&,
               nav::View&) noexcept {}
  void guard(nav::Manoeuvre&, const Pose&, const motion::WheelState&, Duration, const Params&) noexcept {}
};

/// The one that the core is built with.
#ifdef WHISKER_SMALL
using Mapper = NoMapper;
#else
using Mapper = GroundMapper;
#endif

}  // namespace whisker

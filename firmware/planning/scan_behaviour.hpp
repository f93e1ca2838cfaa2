/// Scans a path that is unknown.
#pragma once

#include "firmware/params.hpp"
#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Turns beams onto unseen ground on a path until the path is free or occupied. It ends in vain when a beam
/// has pointed there, or the guard has let no turn through, for the time-out of stalled wheels: with coarse
/// encoders a beam may not point there exactly.
///
/// If single readings cannot clear the cells at the rim (Reach::past), a beam sweeps past the nearest unseen
/// cell, to and fro, until it is clear; in vain after four sweeps that cleared nothing.
class ScanBehaviour {
 public:
  /// Starts a scan of the path along this heading. Brings the body to rest.
  void begin(Angle heading, Length length, Manoeuvre& manoeuvre) noexcept;
  /// Once per tick, for the path from the body's position. True: finished; otherwise sets the manoeuvre.
  bool step(const View& view, const Params& params, Manoeuvre& manoeuvre) noexcept;
  /// The scan ended, and the path is still unknown.
  bool in_vain() const noexcept { return in_vain_; }

 private:
  void halt(Manoeuvre& manoeuvre) noexcept;
  bool sweep(const View& view, const Unseen& rest, const Params& params, Manoeuvre& manoeuvre) noexcept;

  Angle heading_;
  Length length_;
  bool halting_ = false;
  bool in_vain_ = false;
  bool left_ = false;    // sweeps to the left
  int8_t sweeps_ = 0;    // past a cell
  Angle aim_;            // of the body, for the nearest unseen cell
  int32_t cells_ = 0;    // the fewest unseen ones so far
  Duration waited_for_;  // aimed, or held by the guard
};

}  // namespace whisker::planning

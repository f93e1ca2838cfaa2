/// A scan of a way that is not known.
#pragma once

#include "firmware/params.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Turns beams onto what was never seen in a way, until the way is free or occupied, or a beam has pointed
/// there for as long as stalled wheels are waited for: coarse encoders may not let it point there well
/// enough.
class ScanBehaviour {
 public:
  /// Of the way along this heading. Brings the body to rest.
  void begin(Angle heading, Length length, Manoeuvre& manoeuvre) noexcept;
  /// Once a tick, for the way from where the body is. True: over; otherwise what to do next.
  bool step(const View& view, const Params& params, Manoeuvre& manoeuvre) noexcept;
  /// It is over, and the way is as unknown as before.
  bool in_vain() const noexcept { return in_vain_; }

 private:
  void halt(Manoeuvre& manoeuvre) noexcept;

  Angle heading_;
  Length length_;
  bool halting_ = false;
  bool in_vain_ = false;
  Duration aimed_for_;
};

}  // namespace whisker::planning

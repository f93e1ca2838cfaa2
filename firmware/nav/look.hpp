/// A look where the way is not known.
#pragma once

#include "firmware/nav/planner.hpp"
#include "firmware/params.hpp"

namespace whisker::nav {

/// Turns beams onto what was never seen in a way, until the way is free or blocked.
class Look {
 public:
  /// Brings the body to rest.
  void begin(Manoeuvre& manoeuvre) noexcept;
  /// Along this way from where the body is. True: over; otherwise what to do next.
  bool step(const View& view, Angle heading, Length length, const Params& params,
            Manoeuvre& manoeuvre) noexcept;

 private:
  bool halting_ = false;
};

}  // namespace whisker::nav

/// The pace that the response table sets where clear ground is in doubt.
#pragma once

#include "firmware/math/units.hpp"
#include "firmware/params.hpp"

namespace whisker::safety {

/// SD as a speed: SD x base, where the largest SD of the core's table is the full speed, or less if the body
/// does not stop from that within an eighth of what the table sees.
///
/// It rises at a quarter of the wheels' acceleration and falls at half of it, so that the body does not jerk
/// where beams pass gaps.
///
/// No table gives more than a fifth of D: M at half of the sight is the base, and what is nearer allows less.
/// So the pace rests on nothing being near in any beam, and not on the rules; docs/safety.md.
class Pace {
 public:
  void configure(const Params& params) noexcept;
  /// What SD allows straight ahead, if the nearest thing that any beam shows is so far away.
  Speed wanted(Q14 step, Length nearest) const noexcept;
  /// Once per tick: the pace follows this one, and rises from at least `floor`. Zero: at once.
  Speed follow(Speed wanted, Speed floor, Duration elapsed, const Params& params) noexcept;
  /// Zero: there is none.
  Speed now() const noexcept { return now_; }
  /// No pace: the next one rises from the floor.
  void stand() noexcept { now_ = Speed{}; }

 private:
  Speed base_;
  Speed now_;
  Length middle_;  // half of the sight
};

}  // namespace whisker::safety

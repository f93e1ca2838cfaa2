/// The heading towards the goal: the response table's, or the first one beside it that is not blocked.
#pragma once

#include "firmware/params.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// How far free space bends the course away from the goal's direction.
class HeadingDeflection {
 public:
  /// From what the beams see with nothing but the goal beyond; counter-clockwise positive. Notes what it used
  /// in the decision.
  virtual Angle bend(const perception::Echoes& sight, const Params& params, Decision& decision) noexcept = 0;

 protected:
  ~HeadingDeflection() = default;
};

class Course {
 public:
  /// Straight at the goal again.
  void reset() noexcept { bend_ = 0; }

  /// Once per sensor update. False: every heading within 75 degrees of the goal's is blocked.
  /// `wall` is the side that it last had an obstacle on; it turns away from it first, and updates it.
  bool choose(const View& view, const Vec& to_goal, HeadingDeflection& law, const Params& params, Side& wall,
              Decision& decision) noexcept;
  Angle heading() const noexcept { return heading_; }

 private:
  void bend_towards(Angle wanted) noexcept;

  Angle heading_;
  int32_t bend_ = 0;  // filtered; 2^-32 turn
};

}  // namespace whisker::planning

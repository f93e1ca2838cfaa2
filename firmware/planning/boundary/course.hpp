/// The heading towards the goal: the response table's, or the first unoccupied candidate beside it.
#pragma once

#include "firmware/params.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Law that deflects the course from the goal's direction in free space, and may set the pace.
class HeadingDeflection {
 public:
  /// Once per sensor update, whatever the planner does: how far to deflect this course, counter-clockwise
  /// positive. A law with a response table writes its inputs and answers into the decision.
  virtual Angle deflect(const View& view, Angle course, const Params& params,
                        Decision& decision) noexcept = 0;

 protected:
  ~HeadingDeflection() = default;
};

class Course {
 public:
  /// Resets the course to straight at the goal.
  void reset() noexcept {
    bend_ = 0;
    next_ = 0;
  }

  /// Once per sensor update, and once per tick while it searches(): until then, the heading stays. False:
  /// every heading within 75 degrees of the goal's is occupied. `deflection`: see HeadingDeflection. `wall`
  /// is the side of the last obstacle: headings away from it come first. It is updated.
  bool choose(const View& view, const Vec& to_goal, Angle deflection, const Params& params, Side& wall,
              Decision& decision) noexcept;
  bool searches() const noexcept { return next_ != 0; }
  Angle heading() const noexcept { return heading_; }

 private:
  struct Candidate;
  void bend_towards(Angle wanted) noexcept;
  Candidate candidate(int n, Angle target, Side wall) const noexcept;
  Candidate coarse(int n, Angle target, Side wall) const noexcept;

  Angle heading_;
  int32_t bend_ = 0;   // filtered; 2^-32 turn
  int8_t next_ = 0;    // candidate of the search
  int8_t nearly_ = 0;  // the candidate with the least cells in its way
  int8_t least_ = 0;   // their number, if they are few
};

}  // namespace whisker::planning

/// The rule of one bug algorithm: where it drives, on which side it follows, and when it leaves.
#pragma once

#include "firmware/params.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/boundary/target.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::baselines {

class LeaveRule {
 public:
  /// From here, to the goal, as if newly set.
  virtual void begin(const planning::View& view, const planning::Target& target) = 0;
  /// Where to go in the open.
  virtual Angle course(const planning::View& view, const planning::Target& target) const = 0;
  /// A boundary is hit: the side that it will be on.
  virtual planning::Side hit(const planning::View& view, const planning::Target& target) = 0;
  /// Once per reading while following. The body leaves if this is true and the course is free so far.
  virtual bool may_leave(const planning::View& view, const planning::Target& target) = 0;
  virtual Length free_to_leave(const planning::View& view) const { return view.local_grid->reach().probe; }
  /// A closed loop proves that the goal is unreachable.
  virtual bool remembers_hit() const { return true; }

 protected:
  ~LeaveRule() = default;
};

/// How far a beam that points within 6 degrees of the goal sees a body free to go; zero without one.
Length seen_free(const planning::View& view, const planning::Target& target, const Params& params);

}  // namespace whisker::baselines

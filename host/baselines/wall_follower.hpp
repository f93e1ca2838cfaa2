/// The left-hand rule, the oldest way out of a maze, with a goal.
#pragma once

#include "host/baselines/walker.hpp"

namespace whisker::baselines {

/// Straight to the goal; at an obstacle its left hand goes to the wall and stays there until a beam that
/// points to the goal sees a way of kSeen, or all the way to it. It remembers nothing, so it cannot tell that
/// a goal is unreachable: it gives up.
class WallFollower final : public Walker {
 public:
  static constexpr Length kSeen = 800_mm;

  explicit WallFollower(const Params& params) noexcept : Walker(params) {}

 private:
  void begin(const planning::View&) override {}
  Angle course(const planning::View&) const override { return bearing(to_goal()); }
  planning::Side hit(const planning::View&) override { return planning::Side::left; }
  bool may_leave(const planning::View& view) override { return seen_free(view) >= min(kSeen, distance()); }
  bool can_tell_unreachable() const override { return false; }
};

}  // namespace whisker::baselines

/// The left-hand rule, the oldest way out of a maze, with a goal.
#pragma once

#include "host/lab/baselines/leave_rule.hpp"

namespace whisker::baselines {

/// Straight to the goal; at an obstacle its left hand goes to the wall and stays there until a beam that
/// points to the goal sees a way of kSeen, or all the way to it. It remembers nothing, so it cannot tell that
/// a goal is unreachable: it gives up.
class WallFollower final : public LeaveRule {
 public:
  static constexpr Length kSeen = 800_mm;

  /// The parameters must outlive it.
  explicit WallFollower(const Params& params) noexcept : params_(params) {}

  void begin(const planning::View&, const planning::Target&) override {}
  Angle course(const planning::View&, const planning::Target& target) const override {
    return target.direction();
  }
  planning::Side hit(const planning::View&, const planning::Target&) override { return planning::Side::left; }
  bool may_leave(const planning::View& view, const planning::Target& target) override {
    return seen_free(view, target, params_) >= min(kSeen, target.distance);
  }
  bool remembers_hit() const override { return false; }

 private:
  const Params& params_;
};

}  // namespace whisker::baselines

/// Bug2. Source: V. J. Lumelsky, A. A. Stepanov, "Path-planning strategies for a point mobile automaton
/// moving amidst unknown obstacles of arbitrary shape", Algorithmica 2, 1987.
#pragma once

#include "host/lab/baselines/leave_rule.hpp"

namespace whisker::baselines {

/// Follows the m-line, the segment from the start to the goal. At an obstacle it turns left (the paper's
/// local direction is any fixed one) and follows the boundary until it meets the m-line nearer to the goal
/// than the hit point, with the path ahead free for at least 60 mm: an obstacle behind that is the next one.
/// Back at the hit point: unreachable.
///
/// A body is not a point: it meets the m-line when its centre crosses it or comes within 30 mm, and nearer
/// means nearer by 30 mm. After a lost boundary it starts a new m-line.
class Bug2 final : public LeaveRule {
 public:
  /// The parameters must outlive it.
  explicit Bug2(const Params& params) noexcept : params_(params) {}

  void begin(const planning::View& view, const planning::Target& target) override;
  Angle course(const planning::View& view, const planning::Target& target) const override;
  planning::Side hit(const planning::View& view, const planning::Target& target) override;
  bool may_leave(const planning::View& view, const planning::Target& target) override;
  Length free_to_leave(const planning::View&) const override { return for_body(params_, 60_mm); }

 private:
  /// How far the body is along the m-line and to the left of it.
  Vec on_line(const planning::View& view) const;

  const Params& params_;
  Vec from_;
  Angle line_;  ///< direction
  Length length_;
  Length hit_distance_;  ///< to the goal
  Length offset_;        ///< from the m-line at the last reading
};

}  // namespace whisker::baselines

/// The rules of the bug algorithms: where each drives, on which side it follows, and when it leaves.
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

/// DistBug. Source: I. Kamon, E. Rivlin, "Sensory-based motion planning with global proofs", IEEE
/// Transactions on Robotics and Automation 13 (6), 1997.
///
/// Drives straight to the goal. At an obstacle it follows the boundary, to the side whose beam measures more,
/// and stores d_min, the smallest distance to the goal so far. It leaves if d - F <= d_min - step: d is the
/// distance to the goal, F the free range towards it. Back at the hit point: unreachable.
///
/// F is the range of a beam within 6 degrees of the goal's direction, minus the body, or the free distance
/// in the local grid. d_min is kept over the boundaries: the paper's rule gives the same if F is exact.
class DistBug final : public LeaveRule {
 public:
  /// The parameters must outlive it.
  explicit DistBug(const Params& params) noexcept : params_(params) {}

  void begin(const planning::View& view, const planning::Target& target) override;
  Angle course(const planning::View& view, const planning::Target& target) const override;
  planning::Side hit(const planning::View& view, const planning::Target& target) override;
  bool may_leave(const planning::View& view, const planning::Target& target) override;

 private:
  const Params& params_;
  Length least_;  ///< d_min
};

/// Bug2. Source: V. J. Lumelsky, A. A. Stepanov, "Path-planning strategies for a point mobile automaton
/// moving amidst unknown obstacles of arbitrary shape", Algorithmica 2, 1987.
///
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

/// The left-hand rule, the oldest way out of a maze, with a goal.
///
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

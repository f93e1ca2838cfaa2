/// What Bug2, DistBug and the wall follower share: they walk towards the goal until something is in the way,
/// then along its boundary until their own rule says "leave".
#pragma once

#include <cstdint>

#include "firmware/nav/goal_planner.hpp"
#include "firmware/nav/look.hpp"
#include "firmware/nav/stall.hpp"
#include "firmware/nav/ways.hpp"
#include "host/baselines/edge_walk.hpp"

namespace whisker::baselines {

/// Ends in *reached* within 7/8 of the goal's tolerance, in *gave up* after kLongest driven or without a way
/// anywhere, and, if the algorithm can tell, in *unreachable*: back where it hit the boundary after a full
/// turn.
class Walker : public nav::GoalPlanner {
 public:
  static constexpr Length kLongest = 400_m;

 protected:
  /// The parameters must outlive the planner.
  explicit Walker(const Params& params) noexcept : params_(params), edge_(params) {}
  ~Walker() = default;

  /// From here, to the goal, as if newly set.
  virtual void begin(const nav::View& view) = 0;
  /// Where to go in the open.
  virtual Angle course(const nav::View& view) const = 0;
  /// A boundary is hit: the side that it will be on.
  virtual nav::Side hit(const nav::View& view) = 0;
  /// Once per reading while following. The walker leaves if this is true and the course is free so far.
  virtual bool may_leave(const nav::View& view) = 0;
  virtual Length free_to_leave(const nav::View& view) const { return view.patch->reach().probe; }
  virtual bool can_tell_unreachable() const = 0;

  const Params& params() const { return params_; }
  Vec goal() const { return goal_.at; }
  Vec to_goal() const { return to_goal_; }
  Length distance() const { return distance_; }  ///< to the goal

  /// How far a beam that points within 6 degrees of the goal sees a body free to go; zero without one.
  Length seen_free(const nav::View& view) const;

 private:
  enum class Phase : std::uint8_t { halt, survey, go, look_ahead, follow, look_away };

  void start(const nav::View& view) noexcept final;
  void advance(const nav::View& view) noexcept final;
  void account(const nav::View& view);
  void act(const nav::View& view);
  void survey(const nav::View& view);
  void go(const nav::View& view);
  void look(const nav::View& view);
  void begin_follow(const nav::View& view);
  void follow(const nav::View& view);
  bool leave(const nav::View& view);
  nav::Way way_off(const nav::View& view, Angle heading) const;
  bool came_round(const nav::View& view) const;
  void enter(Phase phase, nav::Mode mode, nav::Why why);

  const Params& params_;
  EdgeWalk edge_;
  nav::Look look_;
  nav::Stall stall_;
  Phase phase_ = Phase::survey;

  Pose last_;
  Vec to_goal_;
  Length distance_;
  std::int64_t travel_um_ = 0;
  Angle course_;
  bool surveyed_left_ = false;

  Vec hit_at_;
  bool on_its_way_ = false;  ///< along the boundary, away from where it hit: these say from where
  Pose mark_;
  std::int64_t mark_travel_um_ = 0;
  std::int64_t turned_ = 0;  ///< since the mark, 2^-32 turn, counter-clockwise positive
  std::int64_t looked_um_ = 0;
  Angle walk_heading_;  ///< before a look away from the wall
};

}  // namespace whisker::baselines

/// What Bug2, DistBug and the wall follower share: they walk towards the goal until something is in the way,
/// then along its boundary until their own rule says "leave".
#pragma once

#include <cstdint>

#include "firmware/planning/boundary/stuck_detector.hpp"
#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/goal_planner.hpp"
#include "firmware/planning/scan_behaviour.hpp"
#include "host/baselines/edge_walk.hpp"

namespace whisker::baselines {

/// Ends in *reached* within 7/8 of the goal's tolerance, in *gave up* after kLongest driven or without a way
/// anywhere, and, if the algorithm can tell, in *unreachable*: back where it hit the boundary after a full
/// turn.
class Walker : public planning::GoalPlanner {
 public:
  static constexpr Length kLongest = 400_m;

 protected:
  /// The parameters must outlive the planner.
  explicit Walker(const Params& params) noexcept : params_(params), edge_(params) {}
  ~Walker() = default;

  /// From here, to the goal, as if newly set.
  virtual void begin(const planning::View& view) = 0;
  /// Where to go in the open.
  virtual Angle course(const planning::View& view) const = 0;
  /// A boundary is hit: the side that it will be on.
  virtual planning::Side hit(const planning::View& view) = 0;
  /// Once per reading while following. The walker leaves if this is true and the course is free so far.
  virtual bool may_leave(const planning::View& view) = 0;
  virtual Length free_to_leave(const planning::View& view) const { return view.local_grid->reach().probe; }
  virtual bool can_tell_unreachable() const = 0;

  const Params& params() const { return params_; }
  Vec goal() const { return goal_.at; }
  Vec to_goal() const { return to_goal_; }
  Length distance() const { return distance_; }  ///< to the goal

  /// How far a beam that points within 6 degrees of the goal sees a body free to go; zero without one.
  Length seen_free(const planning::View& view) const;

 private:
  enum class Phase : std::uint8_t { halt, survey, go, look_ahead, follow, look_away };

  void start(const planning::View& view) noexcept final;
  void advance(const planning::View& view) noexcept final;
  void account(const planning::View& view);
  void act(const planning::View& view);
  void survey(const planning::View& view);
  void go(const planning::View& view);
  void look(const planning::View& view);
  void begin_follow(const planning::View& view);
  void follow(const planning::View& view);
  bool leave(const planning::View& view);
  planning::Way way_off(const planning::View& view, Angle heading) const;
  bool came_round(const planning::View& view) const;
  void enter(Phase phase, planning::Mode mode, planning::Why why);

  const Params& params_;
  EdgeWalk edge_;
  planning::ScanBehaviour scan_;
  planning::StuckDetector stuck_;
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

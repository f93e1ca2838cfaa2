/// The bug algorithms on a body that must not touch: towards the goal until something is in the way, then
/// along its boundary by the core's follower until the leave rule says so.
#pragma once

#include <cstdint>

#include "firmware/planning/boundary/behaviours.hpp"
#include "firmware/planning/boundary/boundary_follower.hpp"
#include "firmware/planning/boundary/loop_detector.hpp"
#include "firmware/planning/boundary/survey.hpp"
#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/goal_planner.hpp"
#include "host/lab/baselines/leave_rules.hpp"

namespace whisker::baselines {

/// Ends in *reached* within 7/8 of the goal's tolerance, in *gave up* after kLongest driven or without a way
/// anywhere, and, if the rule remembers where it hit, in *unreachable*: the loop is closed.
class BugPlanner final : public planning::GoalPlanner {
 public:
  static constexpr Length kLongest = 400_m;

  /// Both references must outlive the planner.
  BugPlanner(const Params& params, LeaveRule& rule) noexcept
      : rule_(rule), behaviours_(params), follower_(behaviours_) {}

 private:
  enum class Phase : std::uint8_t { survey, go, look_ahead, follow, look_away, arrive };

  void start(const planning::View& view) noexcept override;
  void advance(const planning::View& view) noexcept override;
  void act(const planning::View& view);
  void go(const planning::View& view);
  void look(const planning::View& view);
  void begin_follow(const planning::View& view);
  void follow(const planning::View& view);
  void arrive(const planning::View& view);
  bool loop_ends(const planning::View& view);
  bool leave(const planning::View& view);
  bool looks_away(const planning::View& view);
  planning::Way way_off(const planning::View& view) const;
  void scan(const planning::View& view, Phase phase);
  void enter(Phase phase, planning::Mode mode, planning::Why why);

  LeaveRule& rule_;
  planning::Behaviours behaviours_;
  planning::BoundaryFollower follower_;
  planning::LoopDetector loop_;
  planning::Survey survey_;
  planning::Target target_;
  Phase phase_ = Phase::survey;
  planning::Side wall_ = planning::Side::left;
  std::int32_t looked_mm_ = 0;
  Angle course_;
  Angle follow_heading_;  ///< before the scan away from the wall
};

/// A bug planner with its rule.
template <class Rule>
struct RuledPlanner {
  /// The parameters must outlive it.
  explicit RuledPlanner(const Params& params) : rule(params), planner(params, rule) {}
  Rule rule;
  BugPlanner planner;
};

}  // namespace whisker::baselines

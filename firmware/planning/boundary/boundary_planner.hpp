/// Avoids the deadlocks of the thesis planner, with the same steering: it follows the boundary of an obstacle
/// that blocks the path. A member of the DistBug family.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/perception/lane.hpp"
#include "firmware/planning/boundary/approach.hpp"
#include "firmware/planning/boundary/behaviours.hpp"
#include "firmware/planning/boundary/boundary_follower.hpp"
#include "firmware/planning/boundary/evasion.hpp"
#include "firmware/planning/boundary/follow_side_search.hpp"
#include "firmware/planning/boundary/gap_passage.hpp"
#include "firmware/planning/boundary/loop_detector.hpp"
#include "firmware/planning/boundary/slit_search.hpp"
#include "firmware/planning/boundary/survey.hpp"
#include "firmware/planning/boundary/target.hpp"
#include "firmware/planning/goal_planner.hpp"
#include "firmware/planning/transition.hpp"

namespace whisker::planning {

/// Three state machines, drawn in docs/phases.md from their tables: this one switches between driving to the
/// goal (Approach) and following an obstacle's boundary (BoundaryFollower).
///
/// A mission ends: each leave point is nearer to the goal than the one before by 30 mm, each loop is bounded,
/// and so are the path length (`length_budget`) and attempts without progress (ProgressChecker).
class BoundaryPlanner final : public GoalPlanner {
 public:
  enum class Phase : uint8_t {
    survey,       ///< turns to both sides before the first movement
    approach,     ///< towards the goal: see Approach
    choose_side,  ///< the path is blocked: searches the exit with the smaller turn
    boundary,     ///< along the obstacle's boundary: see BoundaryFollower
    evade,        ///< something that moves comes this way: leaves its path, see Evasion
    gap,          ///< through a narrow gap in the boundary: see GapPassage
    arrive,       ///< at the goal: comes to rest
    over,         ///< the mission has ended
  };
  enum class Event : uint8_t {
    surveyed,
    blocked,     ///< no heading towards the goal is free
    exit,        ///< the side is chosen
    no_exit,     ///< no side has an exit: follows the wall in front
    nearer,      ///< the leave rule holds
    closed,      ///< closed the loop once: follow in the other direction
    wall_lost,   ///< repeated laps around another obstacle than the one that blocked the path
    doubted,     ///< the global planner doubts its map, and has a path again
    enclosed,    ///< closed the loop in both directions
    refuted,     ///< the last attempt of the global planner also found no path
    stuck,       ///< no path is free, not even the retreat
    threatened,  ///< something that moves comes this way
    passed,      ///< it has passed, or is out of sight
    slit,        ///< at a place from which a narrow gap was seen
    through,     ///< the body is through the gap
    no_door,     ///< a gap straight ahead is too narrow
    too_narrow,  ///< the body does not fit, or the gap is none
    at_goal,
    slid_off,  ///< at rest, but outside the goal's tolerance
    settled,   ///< at rest at the goal
  };

  static constexpr Transition<Phase, Event> kTransitions[] = {
      {Phase::survey, Event::surveyed, Phase::approach, Mode::going, Why::target_free},
      {Phase::approach, Event::blocked, Phase::choose_side, Mode::searching, Why::target_blocked},
      {Phase::choose_side, Event::exit, Phase::boundary, Mode::following},
      {Phase::choose_side, Event::no_exit, Phase::boundary},
      {Phase::boundary, Event::nearer, Phase::approach, Mode::going, Why::target_free},
      {Phase::boundary, Event::closed, Phase::boundary, Mode::idle, Why::came_round},
      {Phase::boundary, Event::wall_lost, Phase::approach, Mode::going, Why::wall_lost},
      {Phase::boundary, Event::doubted, Phase::approach, Mode::going, Why::wall_lost},
      {Phase::boundary, Event::enclosed, Phase::over, Mode::unreachable, Why::came_round},
      {Phase::approach, Event::refuted, Phase::over, Mode::unreachable, Why::came_round},
      {Phase::boundary, Event::stuck, Phase::over, Mode::gave_up, Why::no_exit},
      {Phase::approach, Event::threatened, Phase::evade},
      {Phase::choose_side, Event::threatened, Phase::evade},
      {Phase::boundary, Event::threatened, Phase::evade},
      {Phase::evade, Event::passed, Phase::approach, Mode::going, Why::target_free},
      {Phase::evade, Event::at_goal, Phase::arrive},
      {Phase::boundary, Event::slit, Phase::gap, Mode::looking, Why::opening},
      {Phase::approach, Event::slit, Phase::gap, Mode::looking, Why::opening},
      {Phase::choose_side, Event::slit, Phase::gap, Mode::looking, Why::opening},
      {Phase::gap, Event::no_door, Phase::approach, Mode::going, Why::target_free},
      {Phase::gap, Event::through, Phase::approach, Mode::going, Why::target_free},
      {Phase::gap, Event::too_narrow, Phase::boundary, Mode::following, Why::edge},
      {Phase::survey, Event::at_goal, Phase::arrive},
      {Phase::approach, Event::at_goal, Phase::arrive},
      {Phase::choose_side, Event::at_goal, Phase::arrive},
      {Phase::boundary, Event::at_goal, Phase::arrive},
      {Phase::gap, Event::at_goal, Phase::arrive},
      {Phase::arrive, Event::slid_off, Phase::approach},
      {Phase::arrive, Event::settled, Phase::over, Mode::arrived, Why::at_goal},
  };

  /// The arguments must outlive the planner. The optional guide gives way points in free space.
  BoundaryPlanner(const Params& params, HeadingDeflection& law, GlobalPlanner* guide = nullptr) noexcept
      : behaviours_(params),
        approach_(law, guide, behaviours_),
        follower_(behaviours_),
        passage_(behaviours_),
        slits_(behaviours_) {}

 private:
  void start(const View& view) noexcept override;
  void advance(const View& view) noexcept override;
  void ponder(const View& view) noexcept override {
    if (decision_.outcome == Outcome::running) approach_.ponder(view);
  }
  void follow_goal() noexcept override { approach_.move_goal(goal_.at); }
  void act(const View& view) noexcept;
  /// An object moves, and the current behaviour results from that.
  bool gives_way(const View& view) const noexcept;

  void on(Event event) noexcept;
  void end(Event event, Outcome outcome) noexcept;
  void survey(const View& view) noexcept;
  void approach(const View& view) noexcept;
  void choose_side(const View& view) noexcept;
  /// True: the planner leaves the boundary.
  bool boundary(const View& view) noexcept;
  void gap(const View& view) noexcept;
  void arrive(const View& view) noexcept;

  void begin_approach(Event event) noexcept;
  void begin_side_search(const View& view) noexcept;
  bool may_leave(const View& view) const noexcept;
  /// There is a slit that was not tried.
  bool knows_slit() const noexcept { return slits_.known(); }
  /// Begins to pass the slit, if it is at hand and worth it.
  bool try_slit(const View& view) noexcept;
  /// The same where the way in this direction is blocked, for a gap as wide as the verdict promises.
  bool try_door(const View& view, Angle way) noexcept;
  void go_the_other_way(const View& view) noexcept;
  void escape(const View& view) noexcept;
  void give_up_goal(const View& view) noexcept;

  Phase phase_ = Phase::survey;
  Side wall_ = Side::left;     ///< side of the current or last obstacle
  bool other_way_ = false;     // closed the loop once
  bool parts_ = false;         // the last loop may separate start and goal
  bool sought_ = false;        // made a loop for slits that the map refutes
  int8_t escapes_ = 0;         // from obstacles that did not block the path
  Why otherwise_ = Why::none;  // the reason, if nothing moved
  int32_t left_edge_mm_ = 0;   // travel at the last leave point
  Target target_;
  Vec began_;  // position when the goal was set

  Behaviours behaviours_;
  Approach approach_;
  BoundaryFollower follower_;
  GapPassage passage_;
  SlitSearch slits_;
  Survey survey_;
  Evasion evasion_;
  FollowSideSearch side_search_;
  LoopDetector loop_;
};

}  // namespace whisker::planning

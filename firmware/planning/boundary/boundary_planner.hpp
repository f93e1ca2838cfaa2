/// The planner that keeps the thesis's ideas and does not deadlock: it skirts what is in its way.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/boundary/course.hpp"
#include "firmware/planning/boundary/follow_side_search.hpp"
#include "firmware/planning/boundary/heading_search.hpp"
#include "firmware/planning/boundary/loop_detector.hpp"
#include "firmware/planning/boundary/stuck_detector.hpp"
#include "firmware/planning/closest_approach.hpp"
#include "firmware/planning/global/global_planner.hpp"
#include "firmware/planning/goal_planner.hpp"
#include "firmware/planning/scan_behaviour.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {

/// ```
/// survey -> go <-> look            towards the goal; a look where the way is not known
///            |  ^
///        hit v  | leave            nearer to the goal than ever before
///         exits -> depart -> follow <-> feel, look, retreat
///                              |
///                              v   back where it was met, both ways round
///                          unreachable
/// ```
/// It ends: each leave is nearer to the goal than the one before by 30 mm, each circuit is bounded, and
/// the length of the way is (`length_budget`), and so is what it tries without getting on. See docs/skirt.md.
class BoundaryPlanner final : public GoalPlanner {
 public:
  /// What is given must outlive the planner. A guide, if there is one, says where to drive in free space.
  BoundaryPlanner(const Params& params, HeadingDeflection& law, GlobalPlanner* guide = nullptr) noexcept
      : params_(params), law_(law), guide_(guide) {}

 private:
  enum class Phase : uint8_t {
    brake,    ///< comes to rest, then goes on with `next_`
    survey,   ///< turns to both sides before the first movement
    go,       ///< towards the goal
    look,     ///< turns a beam onto what is unseen in a way, then goes on with `next_`
    exits,    ///< the target direction is blocked: looks for the exit that needs the smaller turn
    depart,   ///< turns to the heading chosen
    follow,   ///< along the obstacle's edge
    feel,     ///< stands at the edge and takes the first free heading from the wall's side
    retreat,  ///< no heading is free: back the way it came
  };

  void start(const View& view) noexcept override;
  void advance(const View& view) noexcept override;
  void follow_goal() noexcept override;
  /// From here on, progress is what comes nearer than this.
  void measure_anew() noexcept { best_.set(last_.at, distance_); }
  void keep_account(const View& view) noexcept;
  void act(const View& view) noexcept;
  /// Something moves, and what the body does now is due to that.
  bool gives_way(const View& view) const noexcept;

  void survey(const View& view) noexcept;
  void go(const View& view) noexcept;
  bool guided(const View& view, Vec& to) noexcept;
  void look(const View& view) noexcept;
  void begin_exits(const View& view) noexcept;
  void exits(const View& view) noexcept;
  void depart(const View& view) noexcept;
  void follow(const View& view) noexcept;
  bool leave(const View& view) noexcept;
  void escape() noexcept;
  void turn_back(const View& view) noexcept;
  void give_up_goal() noexcept;
  void begin_feel(const View& view, Angle ahead) noexcept;
  /// It wanted to drive and cannot.
  void feel_on(const View& view) noexcept;
  void feel(const View& view) noexcept;
  void retreat(const View& view) noexcept;

  bool stalled(const View& view) noexcept { return stuck_.stalled(view, patience(params_), params_); }
  int32_t mm(Length reference) const noexcept;
  void enter(Phase phase, Mode mode, Why why) noexcept;
  void brake_then(Phase next) noexcept;
  void look_along(Angle heading, Length length, Phase next) noexcept;
  void drive(Twist twist) noexcept { decision_.manoeuvre = cruise(twist, params_); }
  bool turn_to(const View& view, Angle heading) noexcept;

  const Params& params_;
  HeadingDeflection& law_;
  GlobalPlanner* guide_;
  Phase phase_ = Phase::survey;
  Phase next_ = Phase::go;
  Side wall_ = Side::left;  ///< where the obstacle is, or was last

  Vec began_;  // where it was given the goal
  Pose last_;  // of the tick before
  Vec to_goal_;
  Length distance_;        // to the goal
  ClosestApproach best_;   // of the places where it was not following an edge
  int32_t travel_mm_ = 0;  // since the goal was set
  int32_t travel_rest_um_ = 0;
  Course course_;
  FollowSideSearch exits_;
  LoopDetector loop_;
  HeadingSearch heading_search_;
  ScanBehaviour scan_;
  StuckDetector stuck_;

  Angle heading_;  // depart, follow: the one chosen; look: the one looked along
  Length length_;  // look: of the way looked along
  int32_t surveyed_ = 0;
  int32_t left_edge_mm_ = 0;  // travel at which an edge was last left
  int32_t felt_mm_ = 0;       // travel at which it last felt for openings
  int32_t commit_mm_ = 0;     // travel until which the chosen heading is kept
  int32_t paused_mm_ = 0;     // travel at which it last got on
  int16_t pauses_ = 0;        // phases entered since then
  int8_t escapes_ = 0;
  int8_t refusals_ = 0;        // in a row, from one place
  bool guided_ = false;        // drives where the guide says
  bool turned_back_ = false;   // came round once: going round the other way
  bool felt_heading_ = false;  // the heading chosen is the heading search's
  Why otherwise_ = Why::none;  // the reason, if nothing moved
};

/// The planner as it is meant: its course bends by the response table.
struct TableBoundaryPlanner {
  /// Both references must outlive it.
  TableBoundaryPlanner(const Params& params, const fuzzy::Engine::Table& table) noexcept
      : law(table), planner(params, law) {}
  TableDeflection law;
  BoundaryPlanner planner;
};

}  // namespace whisker::planning

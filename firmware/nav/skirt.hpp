/// The planner that keeps the thesis's ideas and does not deadlock: it skirts what is in its way.
#pragma once

#include "firmware/fuzzy/engine.hpp"
#include "firmware/nav/planner.hpp"
#include "firmware/params.hpp"

namespace whisker::nav {

class SkirtPlanner final : public Planner {
 public:
  /// Both references must outlive the planner.
  SkirtPlanner(const Params& params, const fuzzy::Engine::Table& table) noexcept;

  void set_goal(const Goal& goal) noexcept override;
  void cancel() noexcept override;
  Decision step(const View& view) noexcept override;

 private:
  enum class Request : uint8_t { none, goal, cancel };
  enum class Phase : uint8_t {
    rest,
    brake,        ///< comes to rest, then goes on with `next_`
    survey,       ///< turns to both sides before the first movement
    go,           ///< towards the goal, by the response table
    look,         ///< turns a beam onto what is unknown in the way, then goes on with `next_`
    sweep_left,   ///< a hit: turns left until there is a way out
    sweep_right,  ///< and right
    depart,       ///< turns to the heading chosen after a sweep
    follow,       ///< along the obstacle's edge
    feel,         ///< stands at the edge and takes the first free heading from the wall's side
    retreat,      ///< turns to the exact reverse of the way it came
  };
  enum class Way : uint8_t { free, open, blocked };  // open: something in it is unknown

  void start(const View& view) noexcept;
  void act(const View& view) noexcept;
  void keep_account(const View& view) noexcept;

  void survey(const View& view) noexcept;
  void go(const View& view) noexcept;
  bool choose_course(const View& view, Angle& course) noexcept;
  void look(const View& view) noexcept;
  void begin_hit(const View& view) noexcept;
  void sweep(const View& view) noexcept;
  void end_sweep(const View& view) noexcept;
  void depart(const View& view) noexcept;
  void follow(const View& view) noexcept;
  void feel(const View& view) noexcept;
  bool may_leave(const View& view) noexcept;
  bool lost_wall(const View& view) noexcept;
  void begin_feel(const View& view) noexcept;
  Angle way_back(const View& view) const noexcept;
  void retreat(const View& view) noexcept;
  void go_other_way(const View& view) noexcept;
  bool came_round(const View& view) const noexcept;

  Way way(const View& view, Angle heading, Length length) const noexcept;
  bool stalled(const View& view) noexcept;
  void enter(Phase phase, Mode mode, Why why) noexcept;
  void brake_then(Phase next) noexcept;
  void look_along(Angle heading, Length length, Phase next) noexcept;
  void steer(const View& view, Angle heading, Speed top) noexcept;
  bool face(const View& view, Angle heading) noexcept;
  void cruise(Speed forward, AngularRate turn) noexcept;
  void finish(Mode mode, Why why, Outcome outcome) noexcept;

  const Params& params_;
  fuzzy::Engine engine_;
  Decision decision_;
  Goal goal_;
  Request request_ = Request::none;
  Phase phase_ = Phase::rest;
  Phase next_ = Phase::rest;
  bool halting_ = false;

  Pose last_;  // of the tick before
  Vec to_goal_;
  Length distance_;        // to the goal
  Length best_;            // the least of it so far
  int64_t travel_um_ = 0;  // since the goal was set
  int32_t side_ = 1;       // of the wall while following: +1 left; the way last deflected is the other one

  int64_t lean_ = 0;   // the filtered turn of the table, 2^-32 turn
  Angle course_;       // the heading steered for
  Angle look_course_;  // the heading whose way is being looked at
  Length look_length_;
  int32_t slow_ticks_ = 0;
  int32_t stuck_ticks_ = 0;
  int32_t looks_here_ = 0;
  Vec looks_at_;

  Angle bearing_at_hit_;
  Vec hit_at_;
  Angle hit_heading_;
  int64_t hit_travel_um_ = 0;
  int64_t leave_travel_um_ = 0;
  int64_t turned_ = 0;  // since the hit, 2^-32 turn, counter-clockwise positive
  bool moved_away_ = false;

  struct Exit {
    bool feasible = false;
    Angle heading;         // of the first free way
    int32_t turn_deg = 0;  // to it
    int32_t open_deg = 0;  // to the first far view; 0: none
  };
  Exit exit_left_;
  Exit exit_right_;
  int64_t swept_ = 0;      // 2^-32 turn
  int32_t candidate_ = 0;  // the next heading to be judged
  static constexpr int kTrail = 8;
  Vec trail_[kTrail];  // where it came from, 40 mm apart
  int32_t trail_newest_ = 0;
  Vec retreat_to_;
  int32_t retreats_ = 0;
  Angle feel_from_;    // the first heading that is felt for
  bool fine_ = false;  // feels in small steps and with the least margin
  Length reach_;       // of the ways that are felt for
  int32_t laps_ = 0;   // full turns since the hit
  Vec lap_at_;
  int32_t escapes_ = 0;
  bool other_way_ = false;  // came round once: going round the other way
  int64_t felt_travel_um_ = 0;
  int64_t commit_until_um_ = 0;
};

}  // namespace whisker::nav

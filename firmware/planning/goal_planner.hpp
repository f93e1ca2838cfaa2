/// The base of all planners: receives commands and ends missions.
#pragma once

#include <stdint.h>

#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// The goal counts as reached only this far inside its tolerance, because the estimate has an error.
constexpr Length reserve(Length tolerance) noexcept { return tolerance / 8; }

/// The smallest tolerance of a goal that this robot keeps with ideal wheels: a step that ends within
/// drive_tolerance ends inside the reserve, and the reserve holds the rounding of an encoder count. A long
/// way needs more: see Robot::set_goal(). For parameters that check() accepts.
constexpr Length smallest_tolerance(const Params& params) noexcept {
  return max(derived::encoder_count(params) * 8, (derived::drive_tolerance(params) * 8 + micrometres(3)) / 7);
}

/// Processes a command at the next step(), and calls advance() at every other one while the outcome is open.
class GoalPlanner : public Planner {
 public:
  // Inline, so that planners outside the core may use run-time type information, which the core is built
  // without. Setting the same goal again changes nothing.
  void set_goal(const Goal& goal) noexcept final {
    const bool same = goal == goal_;
    goal_ = goal;
    if (!same || request_ != Request::none || decision_.outcome != Outcome::running) request_ = Request::goal;
  }
  void move_goal(Vec at) noexcept final {
    goal_.at = at;
    follow_goal();
  }
  void cancel() noexcept final { request_ = Request::cancel; }
  Decision step(const View& view) noexcept final { return answer(view); }

 protected:
  // Inline, so that no program needs the table of an abstract class, which asks for __cxa_pure_virtual.
  [[gnu::always_inline]] GoalPlanner() noexcept = default;
  ~GoalPlanner() = default;

  /// A new goal is set; the decision is reset.
  virtual void start(const View& view) noexcept = 0;
  /// A tick of the drive to it.
  virtual void advance(const View& view) noexcept = 0;

  /// The goal was moved; distances to it are measured again.
  virtual void follow_goal() noexcept {}

  bool is_goal(Length distance) const noexcept {
    return distance <= goal_.tolerance - reserve(goal_.tolerance);
  }
  /// To be asked on the way: the body is at the goal, and would come no nearer to its middle by driving on.
  /// One that hardly moves stops where it is. `to`: from the body to the goal.
  bool arrives(const Vec& to, Length distance, const View& view, const Params& params) const noexcept;
  void report(Mode mode, Why why) noexcept;
  /// Comes to rest until there is a new goal.
  void finish(Mode mode, Why why, Outcome outcome) noexcept;

  Goal goal_;
  Decision decision_;

 private:
  enum class Request : uint8_t { none, goal, cancel };
  const Decision& answer(const View& view) noexcept;
  Request request_ = Request::none;
};

}  // namespace whisker::planning

/// Interface of a global planner, which knows more than the local grid.
#pragma once

#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class GlobalPlanner {
 public:
  enum class Advice : uint8_t {
    none,    ///< drive straight to the goal, and follow boundaries
    place,   ///< drive to a way point
    wait,    ///< stand: planning in progress
    no_way,  ///< loops were closed, and the map left no other path: the goal is unreachable
  };

  virtual void start(const View& view, const Goal& goal) noexcept = 0;
  /// The goal has moved to `at`.
  virtual void move_goal(Vec at) noexcept = 0;
  /// Call once per tick, also while the guide is not used.
  virtual void observe(const View& view) noexcept = 0;
  /// Call once per tick after that; as Planner::ponder().
  virtual void ponder(const View& view) noexcept = 0;
  /// Where to drive in free space: `place`, relative to the body. `distance` is that of the goal.
  virtual Advice advise(const View& view, Length distance, Vec& place) noexcept = 0;
  /// All headings in that direction are blocked. False: there is no better advice.
  virtual bool refuse(const View& view) noexcept = 0;
  /// One closed loop is enough: it knows no path, or this is its last try.
  virtual bool knows_no_way() const noexcept = 0;
  /// The body has passed a gap where the planner had refused to drive.
  virtual void pass() noexcept = 0;
  /// Boundary following found no path either. True: resets the map's blocked cells to unknown and advises a
  /// last attempt, which ends nearer to the goal than before or with `no_way`.
  virtual bool doubt() noexcept = 0;

 protected:
  ~GlobalPlanner() = default;
};

}  // namespace whisker::planning

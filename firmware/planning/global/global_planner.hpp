/// One who knows more of the way than what lies next to the body.
#pragma once

#include "firmware/planning/planner.hpp"

namespace whisker::planning {

class GlobalPlanner {
 public:
  enum class Advice : uint8_t {
    none,   ///< straight at the goal, and along edges
    place,  ///< to a place on the way
    wait,   ///< stand: the way is being thought over
  };

  virtual void start(const View& view, const Goal& goal) noexcept = 0;
  /// The goal lies there by now.
  virtual void move_goal(Vec at) noexcept = 0;
  /// Once a tick, whatever the body does.
  virtual void observe(const View& view) noexcept = 0;
  /// Where to drive in free space: to `place`, from the body. `distance` is the goal's.
  virtual Advice advise(const View& view, Length distance, Vec& place) noexcept = 0;
  /// Every heading that leads about there is blocked. False: there is no better advice.
  virtual bool refuse(const View& view) noexcept = 0;
  /// It knows of no way at all, or has doubted what it knew already.
  virtual bool knows_no_way() const noexcept = 0;
  /// Along edges there was no way either. True: it doubts what it knew, and there is advice again.
  virtual bool doubt() noexcept = 0;

 protected:
  ~GlobalPlanner() = default;
};

}  // namespace whisker::planning

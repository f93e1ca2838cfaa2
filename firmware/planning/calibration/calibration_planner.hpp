/// What the missions of a calibration share.
#pragma once

#include "firmware/calibration/values.hpp"
#include "firmware/planning/calibration/trouble.hpp"
#include "firmware/planning/goal_planner.hpp"

namespace whisker::planning {

/// Any goal starts it; where the goal lies does not matter. Robot::tick drives it under the guard, as every
/// planner. Outcome::reached: it is done; Outcome::gave_up: see trouble().
class CalibrationPlanner : public GoalPlanner {
 public:
  Trouble trouble() const noexcept { return trouble_; }
  /// What to write into the parameters; nothing is known before it is done.
  const calibration::Values& values() const noexcept { return values_; }

 protected:
  [[gnu::always_inline]] CalibrationPlanner() noexcept = default;  // see GoalPlanner
  ~CalibrationPlanner() = default;
  /// A standard deviation above this one is Trouble::too_uncertain.
  static constexpr Ratio kWorst = millionths(5000);

  void begin() noexcept;
  void end(Trouble trouble) noexcept;

  calibration::Values values_;

 private:
  Trouble trouble_ = Trouble::not_finished;
};

}  // namespace whisker::planning

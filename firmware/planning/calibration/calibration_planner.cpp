#include "firmware/planning/calibration/calibration_planner.hpp"

namespace whisker::planning {

void CalibrationPlanner::begin() noexcept {
  values_ = {};
  trouble_ = Trouble::not_finished;
  decision_.manoeuvre = stop();
  report(Mode::looking, Why::goal_set);
}

void CalibrationPlanner::end(Trouble trouble) noexcept {
  trouble_ = trouble;
  const bool good = trouble == Trouble::none;
  finish(good ? Mode::arrived : Mode::gave_up, good ? Why::at_goal : Why::none,
         good ? Outcome::reached : Outcome::gave_up);
}

}  // namespace whisker::planning

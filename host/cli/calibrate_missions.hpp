/// The missions of a calibration by name, for a controller on this computer.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/apps/can/remote_robot.hpp"
#include "firmware/planning/calibration/square_planner.hpp"
#include "firmware/planning/calibration/straight_planner.hpp"

namespace whisker::cli {

/// spin, straight, tape, square-left, square-right.
std::vector<std::string_view> mission_names();

/// Makes the planner of one mission, anew for each order.
class CalibrationMission final : public can_app::PlannerMaker {
 public:
  /// length_m: of a straight drive or a side.
  CalibrationMission(std::string mission, double length_m);

  planning::Planner& make(const Params& params) noexcept override;

  bool made() const { return planner_ != nullptr; }
  /// not_finished before it is made.
  planning::Trouble trouble() const { return made() ? planner_->trouble() : planning::Trouble::not_finished; }
  const calibration::Values& values() const { return planner_->values(); }
  /// Those of the last order.
  const Params& params() const { return params_; }
  /// For people: what the values do not say.
  std::string found() const;

 private:
  template <class P>
  P* take(const std::shared_ptr<P>& planner) {
    planner_ = planner.get();
    owner_ = planner;
    return planner.get();
  }

  const std::string mission_;
  const Length length_;
  Params params_;
  planning::CalibrationPlanner* planner_ = nullptr;
  const planning::StraightPlanner* straight_ = nullptr;
  const planning::SquarePlanner* square_ = nullptr;
  std::shared_ptr<void> owner_;
};

}  // namespace whisker::cli

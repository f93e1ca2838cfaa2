#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/apps/can/remote_robot.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/calibration/square_planner.hpp"
#include "firmware/planning/calibration/straight_planner.hpp"
#include "host/cli/bus_run.hpp"
#include "host/harness/hil/line.hpp"
#include "host/lab/calibration/sample.hpp"

namespace whisker::cli {

/// The spin could not be completed; what() is the reason in one line.
struct SpinError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// along_m: see Spin. Takes the controller's place on the bus: waits for the base and its order to start,
/// turns on the spot there and back, and stops. Prints what it waits for on standard error. Throws SpinError
/// if the base stops the drive, and Interrupted after a signal: the base brakes by itself.
calibration::Sweep spin_on_bus(const BusChoice& bus, const Params& params, double along_m, hil::Line& line);

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

#include "host/cli/calibrate_missions.hpp"

#include <cmath>

#include <fmt/format.h>

#include "firmware/planning/calibration/spin_planner.hpp"

namespace whisker::cli {

using planning::SquarePlanner;
using planning::StraightPlanner;

std::vector<std::string_view> mission_names() {
  return {"spin", "straight", "tape", "square-left", "square-right"};
}

CalibrationMission::CalibrationMission(std::string mission, double length_m)
    : mission_(std::move(mission)),
      length_(millimetres(static_cast<std::int32_t>(std::lround(length_m * 1e3)))) {}

planning::Planner& CalibrationMission::make(const Params& params) noexcept {
  params_ = params;
  straight_ = nullptr;
  square_ = nullptr;
  if (mission_ == "spin") {
    take(std::make_shared<planning::SpinPlanner>(params_));
  } else if (mission_ == "straight" || mission_ == "tape") {
    const auto way = mission_ == "tape" ? StraightPlanner::Way::there : StraightPlanner::Way::there_and_back;
    straight_ = take(std::make_shared<StraightPlanner>(params_, length_, way));
  } else {
    square_ = take(std::make_shared<SquarePlanner>(
        length_, mission_ == "square-left" ? SquarePlanner::Side::left : SquarePlanner::Side::right));
  }
  return *planner_;
}

std::string CalibrationMission::found() const {
  if (straight_ != nullptr) {
    return fmt::format("drove {:.4f} m by its wheels", straight_->way().raw() * 1e-6);
  }
  if (square_ == nullptr) return "";
  return fmt::format("believed_x_m {:.4f}, believed_y_m {:.4f}", square_->missed().x.raw() * 1e-6,
                     square_->missed().y.raw() * 1e-6);
}

}  // namespace whisker::cli

#include "host/cli/calibrate_drive_bus.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "firmware/planning/calibration/spin_planner.hpp"
#include "firmware/planning/calibration/square_planner.hpp"
#include "firmware/planning/calibration/straight_planner.hpp"
#include "host/cli/bus_run.hpp"
#include "host/cli/calibrate_bus.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/provenance.hpp"

namespace whisker::cli {
namespace {

using planning::SquarePlanner;
using planning::StraightPlanner;

/// The base learns of the end before the controller leaves.
constexpr std::chrono::milliseconds kLeaveAfter{500};

class MissionPlanners final : public can_app::PlannerMaker {
 public:
  MissionPlanners(std::string mission, double length_m)
      : mission_(std::move(mission)),
        length_(millimetres(static_cast<std::int32_t>(std::lround(length_m * 1e3)))) {}

  planning::Planner& make(const Params& params) noexcept override {
    params_ = params;
    straight_ = nullptr;
    square_ = nullptr;
    if (mission_ == "spin") {
      take(std::make_shared<planning::SpinPlanner>(params_));
    } else if (mission_ == "straight" || mission_ == "tape") {
      const auto way =
          mission_ == "tape" ? StraightPlanner::Way::there : StraightPlanner::Way::there_and_back;
      straight_ = take(std::make_shared<StraightPlanner>(params_, length_, way));
    } else {
      square_ = take(std::make_shared<SquarePlanner>(
          length_, mission_ == "square-left" ? SquarePlanner::Side::left : SquarePlanner::Side::right));
    }
    return *planner_;
  }

  bool made() const { return planner_ != nullptr; }
  planning::Trouble trouble() const { return made() ? planner_->trouble() : planning::Trouble::not_finished; }
  const calibration::Values& values() const { return planner_->values(); }
  const Params& params() const { return params_; }

  std::string found() const {
    if (straight_ != nullptr) {
      return fmt::format("drove {:.4f} m by its wheels", straight_->way().raw() * 1e-6);
    }
    if (square_ == nullptr) return "";
    return fmt::format("believed_x_m {:.4f}, believed_y_m {:.4f}", square_->missed().x.raw() * 1e-6,
                       square_->missed().y.raw() * 1e-6);
  }

 private:
  template <class P>
  P* take(const std::shared_ptr<P>& planner) {
    planner_ = planner.get();
    owner_ = planner;
    return planner.get();
  }

  std::string mission_;
  Length length_;
  Params params_;
  planning::CalibrationPlanner* planner_ = nullptr;
  const StraightPlanner* straight_ = nullptr;
  const SquarePlanner* square_ = nullptr;
  std::shared_ptr<void> owner_;
};

}  // namespace

std::vector<std::string_view> mission_names() {
  return {"spin", "straight", "tape", "square-left", "square-right"};
}

BusMission drive_mission_on_bus(const BusChoice& bus, const Params& params, const std::string& mission,
                                double length_m, hil::Line& line) {
  using Clock = std::chrono::steady_clock;
  MissionPlanners planners(mission, length_m);
  std::string early;
  std::optional<Clock::time_point> over;
  const bool interrupted = control_mission_on_bus(
      bus, planners, line,
      [&](const std::string& words) {
        if (planners.trouble() == planning::Trouble::not_finished && planners.made() && words != "drives")
          early = words;
      },
      [&] {
        const bool ended =
            planners.made() && (planners.trouble() != planning::Trouble::not_finished || !early.empty());
        if (ended && !over) over = Clock::now();
        return over && Clock::now() - *over > kLeaveAfter;
      });
  if (interrupted) throw SpinInterrupted();
  if (robot_digest(planners.params()) != robot_digest(params)) {
    fmt::print(stderr, "whisker: the base sent other parameters than those of the robot file\n");
  }
  BusMission result;
  const planning::Trouble trouble = planners.trouble();
  if (trouble != planning::Trouble::none) {
    result.trouble = trouble == planning::Trouble::not_finished ? "it ended early: " + early : name(trouble);
    return result;
  }
  result.values = planners.values();
  result.found = planners.found();
  return result;
}

}  // namespace whisker::cli

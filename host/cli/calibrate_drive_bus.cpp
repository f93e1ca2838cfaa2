#include "host/cli/calibrate_drive_bus.hpp"

#include <chrono>
#include <optional>

#include <fmt/format.h>

#include "host/cli/bus_run.hpp"
#include "host/cli/calibrate_bus.hpp"
#include "host/cli/calibrate_missions.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/provenance.hpp"

namespace whisker::cli {
namespace {

/// The base learns of the end before the controller leaves.
constexpr std::chrono::milliseconds kLeaveAfter{500};

}  // namespace

BusMission drive_mission_on_bus(const BusChoice& bus, const Params& params, const std::string& mission,
                                double length_m, hil::Line& line) {
  using Clock = std::chrono::steady_clock;
  CalibrationMission planners(mission, length_m);
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

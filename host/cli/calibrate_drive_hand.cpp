#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "host/calibration/hand_measured.hpp"
#include "host/cli/calibrate_drive_options.hpp"
#include "host/cli/exit_status.hpp"
#include "host/scenario/error.hpp"

namespace whisker::cli {
namespace {

constexpr double kNoTapeSigma = 0.01;

}  // namespace

calibration::Tape tape_of(const std::string& text) {
  const auto wrong = [&](const char* why) { return UsageError(fmt::format("--tape {}: {}", text, why)); };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw wrong("two lengths in m, as 5:5.034");
  const auto metres = [&](std::string_view part) {
    double value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc{} || end != part.data() + part.size()) throw wrong("two lengths in m, as 5:5.034");
    if (!(value >= 0.5 && value <= 100)) throw wrong("both lengths are 0.5 to 100 m");
    return Length::from_raw(static_cast<std::int32_t>(std::lround(value * 1e6)));
  };
  const std::string_view all = text;
  const calibration::Tape tape{metres(all.substr(0, colon)), metres(all.substr(colon + 1))};
  if (!tape.plausible()) throw wrong("they differ by more than 20 %");
  return tape;
}

int compute_drive(const DriveOptions& o) {
  const DriveRobot robot = read_robot_of(o);
  DriveReport report;
  report.source = "measured by hand";
  report.robot = o.robot;
  report.before = robot.params;
  Params params = robot.params;
  const calibration::ProcedurePlan plan = plan_of(o);
  double scale = 1, scale_sigma = kNoTapeSigma;
  if (!o.tape.empty()) {
    const calibration::Tape tape = tape_of(o.tape);
    calibration::take_tape(report.values, params, tape);
    scale = 1.0 * tape.measured.raw() / tape.driven.raw();
    scale_sigma = 1.0 * calibration::Tape::kSigma.raw() / tape.measured.raw();
    report.steps.push_back({"tape",
                            fmt::format("drove {} m by its wheels, {} m by the tape; +-{:.0f} mm assumed",
                                        tape.driven.raw() * 1e-6, tape.measured.raw() * 1e-6,
                                        calibration::Tape::kSigma.raw() * 1e-3),
                            {}});
    report.refused = apply(report.values, params);
  }
  if (!o.square_ends.empty() && report.refused == ParamFault::none) {
    std::ifstream in(o.square_ends);
    if (!in) throw InputError(o.square_ends, 1, 1, "cannot open");
    std::vector<calibration::SquareEnd> ends = calibration::read_square_ends(in, o.square_ends);
    // The squares were driven with the lengths of the robot file.
    for (calibration::SquareEnd& end : ends) end.believed_x_m *= scale, end.believed_y_m *= scale;
    calibration::ProcedureStep step{"squares", "", {}};
    try {
      const calibration::Umbmark found =
          calibration::take_squares(ends, plan.side_m * scale, scale_sigma, params, report.values);
      step.found = fmt::format("{} of {} m; ratio and track leave {:.1f} mm of a coordinate", ends.size(),
                               plan.side_m, found.residual_m * 1e3);
      report.refused = apply(report.values, params);
    } catch (const std::runtime_error& e) {
      step.ended.trouble = e.what();
    }
    report.steps.push_back(step);
  }
  return print_drive(o, report);
}

}  // namespace whisker::cli

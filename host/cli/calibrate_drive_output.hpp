/// What `whisker robot calibrate-drive` prints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/calibration/drive_procedure.hpp"

namespace whisker::cli {

struct DriveReport {
  std::string source;  ///< for people: where the values come from
  std::string robot;   ///< the file that the lines belong into
  Params before;
  std::vector<calibration::ProcedureStep> steps;
  calibration::Values values;
  ParamFault refused = ParamFault::none;
  std::optional<calibration::WheelErrors> truth;  ///< of a simulated robot
};

/// Lines for people, each ending in a newline.
std::string drive_words(const DriveReport& report);
/// One JSON object without provenance.
std::string drive_json(const DriveReport& report);

/// A line on standard error for each step without a result. Exit status.
int print_failures(const DriveReport& report);

/// One robot of many.
struct DriveTrial {
  DriveReport report;
  bool complete = false;
};
/// The errors of many robots: a table in Markdown, and the same as JSON without provenance.
std::string drive_trials_words(const std::vector<DriveTrial>& trials);
std::string drive_trials_json(const std::vector<DriveTrial>& trials);

}  // namespace whisker::cli

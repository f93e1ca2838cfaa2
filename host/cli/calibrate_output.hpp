/// What `whisker robot calibrate` prints.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/lab/calibration/calibration.hpp"
#include "host/lab/calibration/simulated.hpp"

namespace whisker::cli {

struct CalibrationReport {
  std::string source;  ///< for people: where the readings come from
  std::string robot;   ///< the file that the lines belong into
  calibration::Calibration measured;
  calibration::Advice advice;
  /// Of a simulated robot only.
  std::optional<std::array<calibration::Truth, hal::kBeams>> truth;
};

/// Lines for people, each ending in a newline.
std::string calibration_words(const CalibrationReport& report);
/// One JSON object without provenance.
std::string calibration_json(const CalibrationReport& report);

/// The errors of many trials: a table in Markdown, and the same as JSON without provenance.
std::string trials_words(const std::vector<calibration::TrialResult>& trials);
std::string trials_json(const std::vector<calibration::TrialResult>& trials);

}  // namespace whisker::cli

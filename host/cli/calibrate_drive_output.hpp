/// What `whisker robot calibrate-drive` prints.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/calibration/tape.hpp"
#include "host/cli/bus_run.hpp"
#include "host/lab/calibration/drive_procedure.hpp"

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

struct DriveOptions {
  std::string robot;
  std::string truth;
  std::string scene = "room";
  bool noise = false;
  std::uint64_t seed = 1;
  std::uint64_t count = 0;
  int jobs = 0;
  std::optional<double> straight_m;
  std::optional<double> side_m;
  std::optional<int> squares;
  std::string tape;
  std::string square_ends;
  std::string svg;
  BusChoice bus;
  std::string mission;
  bool json = false;

  bool by_hand() const { return !tape.empty() || !square_ends.empty(); }
};

/// What the robot file says, and with --noise what worlds with noise have.
struct DriveRobot {
  Params params;
  Sensor sensor;
  Noise noise;
};
DriveRobot read_robot_of(const DriveOptions& o);
calibration::ProcedurePlan plan_of(const DriveOptions& o);

/// Throw UsageError.
calibration::Scene scene_of(const std::string& word);
calibration::Tape tape_of(const std::string& text);

/// Each returns the exit status.
int print_drive(const DriveOptions& o, const DriveReport& report);
int simulate_drive(const DriveOptions& o);
int simulate_drives(const DriveOptions& o);
int compute_drive(const DriveOptions& o);

}  // namespace whisker::cli

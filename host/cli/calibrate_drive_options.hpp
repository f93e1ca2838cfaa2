/// What the ways to calibrate wheels and gyro share: simulated, by hand, and on a bus.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/calibration/tape.hpp"
#include "host/calibration/drive_procedure.hpp"
#include "host/cli/bus_options.hpp"
#include "host/cli/calibrate_drive_output.hpp"

namespace whisker::cli {

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

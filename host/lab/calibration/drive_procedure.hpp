/// The whole calibration of wheels and gyro, played in the simulator as a person does it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/lab/calibration/drive_rig.hpp"

namespace whisker::calibration {

struct ProcedurePlan {
  Scene scene = Scene::room;  ///< around the spin
  double tape_m = 5;
  double straight_m = 3;  ///< each way
  double side_m = 1;
  int squares = 5;                ///< to each side
  double tape_sigma_m = 0.002;    ///< how well a person measures the tape
  double corner_sigma_m = 0.005;  ///< and each coordinate of a square's end
};

struct ProcedureStep {
  std::string name;   ///< tape, spin, straight, squares
  std::string found;  ///< for people
  Ended ended;
};

/// What the spin saw, for a picture.
struct SpinSeen {
  planning::RangeProfile first, last;
  std::vector<double> mismatch_mm;  ///< mean of a sample, over the offsets of the search
  double offset_deg = 0;            ///< found
};

struct Procedure {
  std::vector<ProcedureStep> steps;
  Values values;
  Params calibrated;  ///< the parameters with the values, if they fit
  ParamFault refused = ParamFault::none;
  SpinSeen spin;
  /// Every step has a result, and the parameters fit.
  bool complete() const;
};

/// With a gyro: tape, spin, straight drive. Without: spin, squares to both sides, tape. Each step drives with
/// what the steps before have found.
Procedure play(const Params& believed, const Sensor& sensor, const Noise& noise, const WheelErrors& errors,
               const ProcedurePlan& plan, std::uint64_t seed);

/// The value that a perfect calibration finds. The track is the one that turns right together with the found
/// counts per metre.
double best_value(const Params& believed, const WheelErrors& errors, const Values& found, Quantity quantity);

}  // namespace whisker::calibration

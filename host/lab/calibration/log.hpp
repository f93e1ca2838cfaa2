/// Logs of a spin.
#pragma once

#include <istream>
#include <string>

#include "host/lab/calibration/sample.hpp"

namespace whisker::calibration {

struct Log {
  Sweep sweep;
  double start_deg = 0;  ///< heading of the first row
};

/// A trace (CSV) or a log of candump -L, by its first character. robot: number of the robot in a candump log;
/// 0: the first one. Throws InputError, also for a file without a spin's readings.
Log read_log(const std::string& file, const Params& params, int robot);

/// The columns t_s, left_m, front_m, right_m, and est_heading_rad or, where that column is missing or its
/// first field empty, heading_rad; if present, est_x_m and est_y_m; others are ignored, and the order does
/// not matter. Ranges as in host/lab/report/trace.hpp. A row may repeat the measurement of the row before;
/// the parameters say how often the sensors measure, and how late a measurement arrives.
Log read_trace(std::istream& in, const std::string& name, const Params& params);
/// The input sets of one robot; the heading is computed from its counts, from 0 on.
Log read_candump(std::istream& in, const std::string& name, const Params& params, int robot);

}  // namespace whisker::calibration

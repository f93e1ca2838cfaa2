/// The trace of a run as CSV: a header, then one row per control tick. The columns, in order:
///
/// - t_s: s, 3 decimals
/// - x_m, y_m: true position, m, 6 decimals
/// - heading_rad: true heading, rad, 6 decimals, unbounded
/// - left_m, front_m, right_m: measured ranges, m, 4 decimals; a clear one is the maximum range,
///   a too_near one the minimum range, a lost one an empty field
/// - v_left_mps, v_right_mps: true rim speeds, m/s, 5 decimals
/// - state, why: names of planning::Mode and planning::Why
/// - t: the danger counter
/// - looked: 1 if this tick's decision used a static scan, else 0
/// - d, r: fuzzy inputs last used, 4 decimals
/// - sa, sd: fuzzy outputs last used, 5 decimals
/// - cmd_left_mps, cmd_right_mps: commanded rim speeds, m/s, 5 decimals
/// - est_x_m, est_y_m, est_heading_rad: the core's own estimate, m, m, rad, 6 decimals
///
/// - guide: the advice of the planner's map, a name of Guidance
/// - way_x_m, way_y_m: the way point, in the frame of the estimate, 6 decimals
/// - pressed: bump switches, the sum of 1 for the left, 2 for the front and 4 for the right one; 0 without a
///   bumper
/// - sigma_along_m, sigma_across_m, sigma_heading_rad: of the estimate, 6 decimals; empty if unknown
/// - bend_rad: by which SA bends the course now, 5 decimals, to the left positive
/// - pace_mps: that SD sets now straight ahead, 5 decimals; 0 if it sets none
///
/// d, r, sa, sd, bend, pace and the estimate are empty on a bus, which does not carry them. guide and way
/// point are empty for planners without a map and on a bus, too; the way point is empty if the guide has
/// none.
#pragma once

#include <string>

#include "host/harness/run/run_log.hpp"

namespace whisker::report {

/// The header line, without its newline.
extern const char* const kTraceHeader;

/// A range as the columns have it.
std::string range_text(const hal::RangeReading& reading, const RangefinderParams& sensor);

/// The whole file. Lines end in a single newline.
std::string trace_csv(const RunLog& log);

/// trace_csv into a file, as files::write.
void write_trace(const std::string& path, const RunLog& log);

}  // namespace whisker::report

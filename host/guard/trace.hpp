/// The trace of a drive as CSV: a header, then one row per tick. The columns, in order:
///
/// - t_s: s, 3 decimals
/// - x_m, y_m, heading_rad: true pose, 6 decimals
/// - left_m, front_m, right_m: measured ranges, 3 decimals; empty if there is no distance
/// - asked_mps, asked_radps: the last command, 5 decimals
/// - forward, turning: granted shares, 4 decimals; empty without the guard
/// - reason: a name of GuardReason; empty without the guard
/// - v_mps, w_radps: true velocity of the body, 5 decimals
#pragma once

#include <string>

#include "host/guard/drive.hpp"

namespace whisker::guard {

extern const char* const kTraceHeader;
/// Without the newline.
std::string trace_row(const Moment& moment, double track_m);

}  // namespace whisker::guard

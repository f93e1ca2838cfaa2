/// The trace of a drive as CSV: a header, then one row per tick. The columns, in order:
///
/// - t_s: s, 3 decimals
/// - x_m, y_m, heading_rad: true pose, 6 decimals
/// - left_m, front_m, right_m: measured ranges, 4 decimals: a clear one is the maximum range, a too_near
///   one the minimum range, a lost one is empty
/// - v_left_mps, v_right_mps: true speeds of the wheels, 5 decimals
/// - state: guarded, or bare without the guard
/// - why: a name of GuardReason; empty without the guard
/// - asked_v_mps, asked_omega_radps: the last command, 5 decimals
/// - granted_v, granted_omega: granted shares of it, 4 decimals; empty without the guard
#pragma once

#include <string>

#include "host/lab/guard/drive.hpp"

namespace whisker::guard {

extern const char* const kTraceHeader;
/// Without the newline.
std::string trace_row(const Moment& moment, const RangefinderParams& sensors);

/// On one line. `outcome`: reached, contact, fault, gave_up (out of time) or ended. `hash` is that of the
/// commands, in hex.
std::string result_json(const Result& result);

}  // namespace whisker::guard

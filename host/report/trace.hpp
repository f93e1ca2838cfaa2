/// The trace of a run as CSV: a header, then one row per control tick. The columns, in order:
///
/// | column | unit, decimals | |
/// |---|---|---|
/// | t_s | s, 3 | |
/// | x_m, y_m | m, 6 | true position |
/// | heading_rad | rad, 6 | true heading, unbounded |
/// | left_m, front_m, right_m | m, 4 | measured; clear = the maximum range, too_near = the minimum range,
/// lost = empty | | v_left_mps, v_right_mps | m/s, 5 | true rim speeds | | state, why | words | nav::Mode,
/// nav::Why | | t | count | the danger counter | | looked | 0 or 1 | a decision was taken from a look at this
/// tick | | d, r | fuzzy units, 4 | inputs last used | | sa, sd | factors, 5 | outputs last used | |
/// cmd_left_mps, cmd_right_mps | m/s, 5 | commanded rim speeds | | est_x_m, est_y_m, est_heading_rad | m, m,
/// rad, 6 | the core's own estimate |
#pragma once

#include <string>
#include <vector>

#include "host/run/record.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker::report {

/// The header line, without its newline.
extern const char* const kTraceHeader;

/// The whole file. Lines end in a single newline.
std::string trace_csv(const Scenario& scenario, const std::vector<TickRecord>& records);

/// trace_csv into a file, as write_file does it.
void write_trace(const std::string& path, const Scenario& scenario, const std::vector<TickRecord>& records);

}  // namespace whisker::report

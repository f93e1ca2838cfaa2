#pragma once

#include "host/lab/scanner/seen_outlines.hpp"

namespace whisker::scanner {

/// Adds everything that an all-round sensor at this point detects: outlines in range that are not hidden, by
/// rays a quarter of a degree apart (9 mm at 2 m).
void scan_all_round(const std::vector<sim::Segment>& outlines, sim::Vec2 from, double range_m,
                    SeenOutlines& seen);

}  // namespace whisker::scanner

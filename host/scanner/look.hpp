#pragma once

#include "host/scanner/seen.hpp"

namespace whisker::scanner {

/// Adds what a scanner at this point sees all round: whatever lies within the range and behind nothing else,
/// by rays a quarter of a degree apart (9 mm at 2 m).
void look(const std::vector<sim::Segment>& outlines, sim::Vec2 from, double range_m, Seen& seen);

}  // namespace whisker::scanner

/// Runs written by hand: a disc that follows a script past discs, with what its beams would have measured.
#pragma once

#include <vector>

#include "host/run/record.hpp"
#include "host/scenario/scenario.hpp"

namespace whisker::testing {

struct Leg {
  sim::Vec2 to;
  planning::Mode mode = planning::Mode::stepping;
  planning::Why why = planning::Why::target_free;
  int danger_count = 0;
};

/// One record every 10 ms: turns on the spot at 2 rad/s toward each leg's end, looks, then drives at 0.25
/// m/s.
std::vector<TickRecord> follow(const Scenario& scenario, const std::vector<Leg>& legs);

/// A verdict with the figures that belong to the records.
RunResult result_of(Verdict verdict, const Scenario& scenario, const std::vector<TickRecord>& records);

/// 4 x 2.4 m, four discs, a polygon, a wall, a mover; all four classes occur on the way.
Scenario garden();
std::vector<TickRecord> garden_run(const Scenario& scenario);

}  // namespace whisker::testing

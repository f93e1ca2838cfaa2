/// Hand-written runs: a disc follows a script past obstacles, with the ranges that its beams would measure.
#pragma once

#include <vector>

#include "host/harness/run/run_log.hpp"

namespace whisker::testing {

struct Leg {
  sim::Vec2 to;
  planning::Mode mode = planning::Mode::stepping;
  planning::Why why = planning::Why::target_free;
  int danger_count = 0;
};

/// One record every 10 ms: turns on the spot at 2 rad/s towards each leg's end, scans, then drives at 0.25
/// m/s.
std::vector<TickRecord> follow(const Scenario& scenario, const std::vector<Leg>& legs);

/// The log of such a run.
RunLog log_of(const Scenario& scenario, const std::vector<TickRecord>& records, const RunResult& result = {});

/// A verdict with matching figures.
RunResult result_of(Verdict verdict, const Scenario& scenario, const std::vector<TickRecord>& records);

/// 4 x 2.4 m, four discs, a polygon, a wall, a mover; all four activities occur.
Scenario garden();
std::vector<TickRecord> garden_run(const Scenario& scenario);

}  // namespace whisker::testing

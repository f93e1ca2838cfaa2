/// An independent judge of a run: re-checks contact, speed limits and rolling from the records alone, with
/// its own geometry.
#pragma once

#include <string>
#include <vector>

#include "host/harness/run/record.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker::test {

struct Ruling {
  std::string complaint;       ///< empty: no objection
  double min_clearance_m = 0;  ///< over the records
};

Ruling judge(const Scenario& scenario, const std::vector<TickRecord>& records, const RunResult& result);

}  // namespace whisker::test

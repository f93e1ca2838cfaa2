/// Where the map of a planner leaves the way to the edges, and where it takes it again.
#pragma once

#include <vector>

#include "host/run/record.hpp"

namespace whisker::report {

struct HandOver {
  const TickRecord* at;
  bool to_edges;  ///< false: back to the map
};

/// One after the other, those to edges first. Before the map has led for the first time there is none.
std::vector<HandOver> hand_overs(const std::vector<TickRecord>& records);

}  // namespace whisker::report

/// Where the map planner falls back to boundary following, and where the map resumes.
#pragma once

#include <vector>

#include "host/run/record.hpp"

namespace whisker::report {

struct HandOver {
  const TickRecord* at;
  bool to_edges;  ///< false: back to the map
};

/// Alternating, fallbacks first. None before the map has led for the first time.
std::vector<HandOver> hand_overs(const std::vector<TickRecord>& records);

}  // namespace whisker::report

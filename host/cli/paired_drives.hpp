/// Missions driven two ways in the same worlds, and what changes.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "host/campaign/comparison.hpp"
#include "host/campaign/worlds.hpp"
#include "host/run/planners.hpp"

namespace whisker::cli {

/// Drives a mission in one way: side 0 is a, side 1 is b. Called on several threads at once; sets the jerk as
/// in Pair if it knows it. May throw campaign::Stopped once `stop` is true.
using DriveSide = std::function<campaign::Row(std::uint64_t mission, int side, double& jerk,
                                              const std::atomic<bool>& stop)>;

/// Drives missions 0..count-1 both ways on `jobs` threads (0: one per core). False: interrupted before the
/// end.
bool drive_pairs(std::uint64_t count, int jobs, const DriveSide& drive, std::vector<campaign::Pair>& pairs);

/// One mission with the kind's table, which bends the course.
campaign::Row drive_with_jerk(campaign::Mission mission, PlannerKind kind, double& jerk,
                              const std::atomic<bool>& stop);

/// Lines for people.
void print_comparison(std::FILE* out, const campaign::Comparison& c);
/// Without names of the two.
nlohmann::ordered_json comparison_json(const campaign::Comparison& c);
nlohmann::ordered_json estimate_json(const campaign::Estimate& e);

/// "0.987 [0.950, 1.026]"
std::string estimate_text(const campaign::Estimate& e, int digits);

}  // namespace whisker::cli

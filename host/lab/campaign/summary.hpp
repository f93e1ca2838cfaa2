/// Statistics over the rows of a campaign.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/lab/campaign/bounds.hpp"
#include "host/lab/campaign/random_robot.hpp"
#include "host/lab/campaign/row.hpp"

namespace whisker::campaign {

/// A count or measure per metre driven.
struct PerMetre {
  std::optional<Estimate> rate;  ///< total per total metres; none if nothing was driven
  std::optional<Estimate> p50;   ///< of the missions
};

struct Summary {
  std::uint64_t missions = 0;  ///< at least 1
  std::uint64_t no_way = 0;    ///< of these, in worlds without a path to the goal
  std::uint64_t least_seed = 0, greatest_seed = 0;
  std::vector<std::string> worlds;  ///< each once, in order; the scenario files of a campaign count as one
  std::vector<std::string> planners;
  bool random_robots = false;  ///< every mission has a random robot
  Refusals refusals{};         ///< in the draws of the random robots

  /// Shares of all missions. A success is that the robot reports "reached", or "unreachable" if no path
  /// exists: all that it can know.
  Estimate success, reached, unreachable, gave_up, contact, fault;
  Estimate truly_there, off_goal;                   ///< it reports "reached", and that is true, or not
  Estimate false_unreachable;                       ///< "unreachable" although a path may exist
  Estimate estimate_error_p50, estimate_error_p95;  ///< m, of all missions
  Estimate path_p50, path_p95;                      ///< m driven, of all missions

  /// Over the missions that report "reached"; none if there are none.
  std::optional<Estimate> ratio_mean, ratio_p50, ratio_p95;
  std::optional<Estimate> s_per_m_p50, s_per_m_p95;
  std::optional<Estimate> clearance_p5;
  std::optional<Estimate> final_distance_p50, final_distance_p95;  ///< m, true
  /// Over the missions in which the robot drove.
  PerMetre stops, flips, looks, turned;
};

/// At least one row.
Summary summarize(const std::vector<Row>& rows);

/// Lines for people, each ending in a newline.
std::string summary_words(const Summary& summary);

/// One JSON object on one line, without a final newline. Shares are fractions; an estimate is an object with
/// value, low and high; missing values are null.
std::string summary_json(const Summary& summary);

}  // namespace whisker::campaign

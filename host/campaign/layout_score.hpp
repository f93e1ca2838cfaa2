/// What a layout is worth, and which is the best.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/campaign/bounds.hpp"
#include "host/campaign/layouts.hpp"
#include "host/campaign/row.hpp"
#include "host/scenario/coverage.hpp"

namespace whisker::campaign {

struct LayoutScore {
  Layout layout;
  double needed_incidence_deg = 0;  ///< the smallest L with side angle + cone / 2 + L >= 90
  double margin_deg = 0;            ///< what the sensors see beyond it; below 0: walls are invisible
  Strip unseen;                     ///< beside a straight course
  std::uint64_t missions = 0, reached = 0, contacts = 0;
  Estimate success, contact;  ///< shares of the missions
  /// Median of s_per_m over all missions, a mission that does not reach its goal counts as infinite; none:
  /// fewer than half reach it.
  std::optional<double> s_per_m;
  std::optional<double> world_s_per_m[kLayoutKinds];  ///< the same in each kind of kLayoutWorlds
};

/// rows: one campaign after another in the order of kLayoutWorlds, each of the same number of missions.
LayoutScore score(const Layout& layout, const Sensor& sensor, const std::vector<Row>& rows);

/// Best first: walls seen with kIncidenceMargin before walls seen, before others; then fewer contacts; then
/// more goals reached; then less time; then the smaller offset and angle.
void rank(std::vector<LayoutScore>& scores);

/// How rank() came to the first of them: one sentence. Not empty.
std::string reason(const std::vector<LayoutScore>& ranked);

}  // namespace whisker::campaign

#include "host/lab/campaign/row.hpp"

#include <cmath>
#include <string_view>

#include "host/lab/campaign/worlds.hpp"

namespace whisker::campaign {

double rounded(double x) { return std::floor(x * 1e6 + 0.5) / 1e6; }

std::optional<double> ratio(const Row& row) {
  if (!row.shortest_m || *row.shortest_m <= 0) return std::nullopt;
  return row.path_m / *row.shortest_m;
}

std::optional<double> s_per_m(const Row& row) {
  if (!row.shortest_m || *row.shortest_m <= 0) return std::nullopt;
  return row.time_s / *row.shortest_m;
}

bool has_no_way(const Row& row) {
  if (is_scenario_file(row.world)) return false;
  const std::string_view world = row.world;
  const std::optional<worlds::Kind> kind = worlds::kind_named(world.substr(0, world.find(' ')));
  return kind && worlds::has_no_way(*kind);
}

bool succeeded(const Row& row) {
  return has_no_way(row) ? row.verdict == Verdict::unreachable : says_reached(row.verdict);
}

bool truly_there(const Row& row) { return row.verdict == Verdict::reached; }

}  // namespace whisker::campaign

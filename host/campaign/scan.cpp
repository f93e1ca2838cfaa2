#include "host/campaign/scan.hpp"

#include "host/campaign/mission.hpp"
#include "host/run/spec.hpp"
#include "host/scanner/reference_path.hpp"

namespace whisker::campaign {

Row scan(const Scenario& scenario) {
  const scanner::ReferencePath reference =
      scanner::drive(make_world(scenario), scenario.start.at, scenario.goal.at, kWayRadius,
                     robot_spec(scenario).beams[hal::kFront].max_range);
  Row row;
  row.seed = scenario.seed;
  row.verdict = reference.reached ? Verdict::reached : Verdict::unreachable;
  row.path_m = rounded(reference.driven_m);
  if (reference.shortest_m) row.shortest_m = rounded(*reference.shortest_m);
  row.planner = "scanner";
  return row;
}

}  // namespace whisker::campaign

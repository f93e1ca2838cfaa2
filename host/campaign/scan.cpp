#include "host/campaign/scan.hpp"

#include "host/campaign/mission.hpp"
#include "host/scanner/trip.hpp"
#include "host/sim/spec.hpp"

namespace whisker::campaign {

Row scan(const Scenario& scenario) {
  const scanner::Trip trip = scanner::drive(make_world(scenario), scenario.start.at, scenario.goal.at,
                                            kWayRadius, sim::robot_spec(scenario.robot).max_range);
  Row row;
  row.seed = scenario.seed;
  row.verdict = trip.reached ? Verdict::reached : Verdict::unreachable;
  row.path_m = rounded(trip.driven_m);
  if (trip.shortest_m) row.shortest_m = rounded(*trip.shortest_m);
  row.planner = "scanner";
  return row;
}

}  // namespace whisker::campaign

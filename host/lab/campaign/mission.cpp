#include "host/lab/campaign/mission.hpp"

#include <cmath>

#include "host/harness/run/runner.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/world.hpp"
#include "host/lab/campaign/motion_count.hpp"
#include "host/lab/paths/shortest.hpp"
#include "host/lab/scanner/reference_path.hpp"

namespace whisker::campaign {
Row drive(const Scenario& scenario, PlannerKind planner, const std::atomic<bool>& stop, double way_radius_m,
          const std::function<void(const TickRecord&)>& also) {
  MotionCount count(scenario.robot.body.track.raw() * 1e-6);
  double estimate_error_m = 0;
  RunOptions options;
  options.planner = planner;
  options.watch = [&](const Moment& moment) {
    const TickRecord& record = moment.record;
    if (stop) throw Stopped{};
    count.add(record);
    if (also) also(record);
    const double x = record.est_x_m - record.x_m, y = record.est_y_m - record.y_m;
    estimate_error_m = std::sqrt(x * x + y * y);
  };
  const RunResult result = run(scenario, options);

  Row row;
  row.seed = scenario.seed;
  row.verdict = result.verdict;
  row.time_s = rounded(result.time_s);
  row.path_m = rounded(result.path_m);
  row.turned_rad = rounded(count.turned_rad());
  row.stops = count.stops();
  row.flips = count.flips();
  row.looks = count.looks();
  row.min_clearance_m = rounded(result.min_clearance_m);
  row.final_distance_m = rounded(result.final_distance_m);
  if (result.believed_distance_m) row.believed_distance_m = rounded(*result.believed_distance_m);
  row.estimate_error_m = rounded(estimate_error_m);
  row.at_goal = at_goal(result.final_distance_m, scenario.goal.tolerance_m);
  const auto shortest_m =
      paths::shortest_path(make_world(scenario), scenario.start.at, scenario.goal.at, way_radius_m);
  if (shortest_m) row.shortest_m = rounded(*shortest_m);
  row.ticks = result.ticks;
  row.hash = result.hash;
  row.detail = result.detail;
  row.planner = name(planner);
  return row;
}

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

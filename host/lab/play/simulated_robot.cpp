#include "host/lab/play/simulated_robot.hpp"

#include <cmath>

#include "host/harness/scenario/shapes.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::play {
namespace {

constexpr double kNotedEvery = 0.005;  // m

}  // namespace

void SimulatedRobot::note(sim::Vec2 at, int kind) {
  if (way_.empty()) {
    way_.push_back({at, kind});
    return;
  }
  const sim::Vec2 step = at - way_.back().at;
  const double square = sim::dot(step, step);
  const bool far = square >= kNotedEvery * kNotedEvery;
  if (far || (square > 0 && kind != way_.back().kind)) way_.push_back({at, kind});
}

sim::Pose in_world(const sim::Pose& origin, const Pose& believed) {
  const double x = report::metres(believed.at.x), y = report::metres(believed.at.y);
  const double c = std::cos(origin.heading), s = std::sin(origin.heading);
  return {{origin.at.x + c * x - s * y, origin.at.y + s * x + c * y},
          origin.heading + report::radians(believed.heading)};
}

void add_estimate(const sim::Pose& believed, TickRecord& record) {
  record.est_x_m = believed.at.x;
  record.est_y_m = believed.at.y;
  record.est_heading_rad = believed.heading;
}

RunResult way_of(const sim::Plant& plant, const Scenario& scenario, std::uint64_t ticks) {
  RunResult r;
  r.path_m = plant.path_length();
  r.final_distance_m = distance(scenario.goal.at, plant.pose().at);
  r.min_clearance_m = std::fmin(plant.min_clearance(), kEmptyWorldClearance);
  r.goal_tolerance_m = scenario.goal.tolerance_m;
  r.ticks = ticks;
  return r;
}

}  // namespace whisker::play

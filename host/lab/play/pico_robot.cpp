#include "host/lab/play/pico_robot.hpp"

#include <cmath>

#include "hal/boards/pico/robot_params.hpp"
#include "host/harness/run/make_record.hpp"
#include "host/harness/scenario/sensor_models.hpp"
#include "host/lab/report/track.hpp"

namespace whisker::play {
namespace {

constexpr double kStands_mps = 0.001;
constexpr std::uint64_t kTick_ms = 10;

}  // namespace

Scenario with_pico(Scenario scenario) {
  scenario.robot = hal::pico::kRobotParams;
  apply(*find_sensor_model("vl53l0x"), scenario.sensor);
  scenario.sensor.far_is = Far::distance;
  return scenario;
}

PicoRobot::PicoRobot(const Scenario& scenario) : rig_(scenario, {}), map_(scenario.robot) {
  note(scenario.start.at, static_cast<int>(report::Doing::free));
}

std::string PicoRobot::step(const std::string& line) {
  std::string answer = rig_.step(line);
  ran_ = ran_ || (rig_.cable().ordered() && rig_.cable().status().outcome == planning::Outcome::running);
  if (++ms_ % kTick_ms != 0) return answer;
  const hil::Shadow* const shadow = rig_.cable().shadow();
  map_.look(shadow != nullptr ? shadow->guide() : nullptr);
  note(rig_.plant().pose().at, static_cast<int>(report::doing(record())));
  return answer;
}

TickRecord PicoRobot::record() const {
  const sim::Plant& plant = rig_.plant();
  TickRecord r;
  r.t_s = plant.time();
  r.ranges = plant.ranges();
  const sim::Pose& start = rig_.scenario().start;
  sim::Pose guess = start;
  if (const hil::Shadow* const shadow = rig_.cable().shadow()) {
    r = make_record(shadow->status(), shadow->guide(), plant.ranges(), plant.time());
    const sim::SinCos to = sim::sin_cos(start.heading);
    guess.at = {start.at.x + to.cos * r.est_x_m - to.sin * r.est_y_m,
                start.at.y + to.sin * r.est_x_m + to.cos * r.est_y_m};
    guess.heading += r.est_heading_rad;
  }
  r.est_x_m = guess.at.x;
  r.est_y_m = guess.at.y;
  r.est_heading_rad = guess.heading;
  r.x_m = plant.pose().at.x;
  r.y_m = plant.pose().at.y;
  r.heading_rad = plant.pose().heading;
  r.v_left_mps = plant.v_left();
  r.v_right_mps = plant.v_right();
  return r;
}

bool PicoRobot::stands() const {
  return std::fabs(rig_.plant().v_left()) < kStands_mps && std::fabs(rig_.plant().v_right()) < kStands_mps;
}

bool PicoRobot::over() const {
  if (!rig_.cable().trouble().empty()) return true;
  const bool ended =
      fault() != Fault::none || (ran_ && rig_.cable().status().outcome != planning::Outcome::running);
  return rig_.plant().in_contact() || (ended && stands());
}

RunResult PicoRobot::result() const {
  const sim::Plant& plant = rig_.plant();
  const sim::Vec2 to = rig_.scenario().goal.at - plant.pose().at;
  RunResult r;
  r.final_distance_m = sim::square_root(sim::dot(to, to));
  r.goal_tolerance_m = rig_.scenario().goal.tolerance_m;
  const Verdict said = verdict_of(rig_.cable().status().outcome).value_or(Verdict::gave_up);
  r.verdict = plant.in_contact()       ? Verdict::contact
              : fault() != Fault::none ? Verdict::fault
                                       : judged(said, r.final_distance_m, r.goal_tolerance_m);
  r.time_s = plant.time();
  r.path_m = plant.path_length();
  r.min_clearance_m = std::fmin(plant.min_clearance(), kEmptyWorldClearance);
  r.ticks = rig_.cable().answers();
  return r;
}

const perception::LocalGrid* PicoRobot::local_grid() const {
  const hil::Shadow* const shadow = rig_.cable().shadow();
  return shadow != nullptr ? shadow->local_grid() : nullptr;
}

Pose PicoRobot::grid_pose() const {
  const hil::Shadow* const shadow = rig_.cable().shadow();
  return shadow != nullptr ? shadow->status().pose : Pose{};
}

}  // namespace whisker::play

#include "host/lab/play/pico_robot.hpp"

#include <cmath>

#include "hal/boards/pico/robot_params.hpp"
#include "host/harness/run/make_record.hpp"
#include "host/harness/scenario/sensor_models.hpp"
#include "host/lab/report/track.hpp"

namespace whisker::play {
namespace {

constexpr double kStands_mps = 0.001;

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
  if (++ms_ % static_cast<std::uint64_t>(params().safety.period.raw()) != 0) return answer;
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
  if (const hil::Shadow* const shadow = rig_.cable().shadow()) {
    r = make_record(shadow->status(), shadow->guide(), r.ranges, r.t_s);
  }
  add_estimate(in_world(rig_.scenario().start, grid_pose()), r);
  add_truth(plant, r);
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
  RunResult r = way_of(plant, rig_.scenario(), rig_.cable().answers());
  const Verdict said = verdict_of(rig_.cable().status().outcome).value_or(Verdict::gave_up);
  r.verdict = plant.in_contact()       ? Verdict::contact
              : fault() != Fault::none ? Verdict::fault
                                       : judged(said, r.final_distance_m, r.goal_tolerance_m);
  r.time_s = plant.time();
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

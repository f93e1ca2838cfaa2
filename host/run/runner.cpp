#include "host/run/runner.hpp"

#include <cmath>

#include "hal/link/command_hash.hpp"
#include "host/run/sim_world.hpp"
#include "host/run/spec.hpp"

namespace whisker {
namespace {

std::optional<Verdict> verdict_of(const Status& status, const Pilot& pilot) {
  if (status.health.fault != Fault::none || pilot.trouble() != nullptr) {
    const bool stands = status.command.left == 0 && status.command.right == 0;
    return stands ? std::optional(Verdict::fault) : std::nullopt;
  }
  switch (status.decision.outcome) {
    case nav::Outcome::reached: return Verdict::reached;
    case nav::Outcome::unreachable: return Verdict::unreachable;
    case nav::Outcome::gave_up: return Verdict::gave_up;
    case nav::Outcome::none:
    case nav::Outcome::running: break;
  }
  return std::nullopt;
}

std::string detail_of(Verdict verdict, const Status& status, const Pilot& pilot) {
  if (verdict == Verdict::fault && status.health.fault == Fault::none) return pilot.trouble();
  return verdict == Verdict::fault ? name(status.health.fault) : nav::name(status.decision.why);
}

TickRecord record_of(const sim::Plant& plant, const Status& status, const hal::RangeReadings& ranges,
                     double t_s) {
  TickRecord r;
  r.t_s = t_s;
  r.x_m = plant.pose().at.x;
  r.y_m = plant.pose().at.y;
  r.heading_rad = plant.pose().heading;
  r.ranges = ranges;
  r.v_left_mps = plant.v_left();
  r.v_right_mps = plant.v_right();
  r.mode = status.decision.mode;
  r.why = status.decision.why;
  r.danger_count = status.decision.danger_count;
  r.looked = status.decision.looked;
  r.d_q7 = status.decision.inputs.distance.raw();
  r.r_q7 = status.decision.inputs.bias.raw();
  r.sa_q14 = status.decision.response.turn.raw();
  r.sd_q14 = status.decision.response.step.raw();
  r.cell = status.decision.response.cell;
  r.command = status.command;
  r.est_x_m = status.pose.at.x.raw() * 1e-6;
  r.est_y_m = status.pose.at.y.raw() * 1e-6;
  r.est_heading_rad = radians(status.pose.heading);
  return r;
}

double distance_left(const sim::Plant& plant, const Scenario& scenario) {
  const sim::Vec2 d = scenario.goal.at - plant.pose().at;
  return std::sqrt(sim::dot(d, d));
}

}  // namespace

RunResult run(const Scenario& scenario, const RunOptions& options) {
  const SimWorld world(scenario);
  const Params& params = scenario.robot;
  sim::Plant plant(world.view(), sim::robot_spec(params), noise_spec(scenario.noise),
                   options.seed.value_or(scenario.seed), scenario.start);
  const std::unique_ptr<Pilot> pilot = options.pilot(scenario, options.planner, plant);

  const std::uint64_t period_ms = static_cast<std::uint64_t>(params.safety.period.raw());
  const std::uint64_t ticks_a_second = 1000 / period_ms;
  RunResult result;
  link::CommandHash hash;
  std::optional<Verdict> verdict;
  const auto record = [&](const Status& status, const hal::RangeReadings& ranges, double t_s) {
    if (options.records == nullptr && !options.observe && !options.watch) return;
    TickRecord r = record_of(plant, status, ranges, t_s);
    r.inside = pilot->sees_inside();
    if (options.records != nullptr) options.records->push_back(r);
    if (options.observe) options.observe(r);
    if (options.watch) options.watch({r, status.health, pilot->patch()});
  };
  for (std::uint64_t tick = 0; !verdict; ++tick) {
    const double t_s = static_cast<double>(tick * period_ms) / 1000.0;
    const hal::RangeReadings ranges = plant.ranges();
    const Status& status = pilot->tick(Time::from_raw(static_cast<std::uint32_t>(tick * period_ms)));
    hash.add(status.command);
    ++result.ticks;
    result.time_s = t_s;
    record(status, ranges, t_s);
    verdict = verdict_of(status, *pilot);
    if (verdict) {
      result.detail = detail_of(*verdict, status, *pilot);
      break;
    }
    const double next_s = static_cast<double>((tick + 1) * period_ms) / 1000.0;
    if (next_s > scenario.time_limit_s) {
      verdict = Verdict::gave_up;
      result.detail = "time_limit";
      break;
    }
    plant.advance();
    if (plant.in_contact()) {
      verdict = Verdict::contact;
      result.time_s = plant.contact_time();
      result.detail = nav::name(status.decision.mode);
      record(status, plant.ranges(), next_s);
    }
    if (options.progress && tick % ticks_a_second == 0) options.progress(t_s, distance_left(plant, scenario));
  }
  result.verdict = *verdict;
  result.path_m = plant.path_length();
  result.final_distance_m = distance_left(plant, scenario);
  result.min_clearance_m = std::fmin(plant.min_clearance(), kEmptyWorldClearance);
  result.hash = hash.value();
  return result;
}

}  // namespace whisker

#include "host/lab/hunt/draw.hpp"

#include <algorithm>
#include <cmath>

#include "host/lab/campaign/random_robot.hpp"
#include "host/lab/hunt/events.hpp"
#include "host/lab/hunt/geometry.hpp"
#include "host/lab/hunt/parts/parts.hpp"
#include "host/lab/hunt/premise.hpp"

namespace whisker::hunt {
namespace {

constexpr double kLongestGuard_s = 30;
constexpr double kLongestMission_s = 400;
constexpr double kMission_s = 60;
constexpr double kEventful = 0.25;
constexpr double kMissions = 0.12;  // about half of the processor time
// Nothing proves what keeps a robot that loses walls from touching them: docs/safety.md.
constexpr double kLossyMissions = 0.5;
constexpr double kLossyMission_s = 300;
constexpr std::size_t kManyShapes = 300;

PlannerKind draw_planner(Dice& dice) {
  const double which = dice.uniform(0, 1);
  return which < 0.6 ? PlannerKind::map : which < 0.85 ? PlannerKind::boundary : PlannerKind::thesis;
}

/// Slow robots in their large worlds take longer; worlds of many obstacles make slow trials.
double mission_time_s(const Scenario& s) {
  const Params usual, &p = s.robot;
  const double driving = campaign::size_of(p) * usual.wheels.max_speed.raw() / p.wheels.max_speed.raw();
  const double turning = static_cast<double>(turn_rate(usual).raw()) / turn_rate(p).raw();
  const double longest_s = count_shapes(s) > kManyShapes ? kMission_s : kLongestMission_s;
  const double usual_s = loses_walls(p.rangefinders) ? kLossyMission_s : kMission_s;
  return std::min(longest_s, usual_s * std::max({1.0, driving, turning}));
}

void draw_driver(Dice& dice, Case& c) {
  c.attacker = dice.bits();
  const bool lossy = loses_walls(c.scenario.robot.rangefinders);
  if (dice.chance(lossy ? kLossyMissions : kMissions)) c.planner = draw_planner(dice);
  if (dice.chance(0.2)) c.gaps = dice.bits() >> 1;
  // The guard refuses parameters with a creep speed.
  if (c.scenario.robot.bumper.creep_speed != Speed{}) c.planner = c.planner.value_or(PlannerKind::map);
}

void set_time(Dice& dice, Case& c) {
  c.scenario.time_limit_s =
      c.planner ? mission_time_s(c.scenario) : std::ceil(dice.log_uniform(3, kLongestGuard_s));
}

/// Drops, repeats or turns what the operator commanded for a while, or stretches all of it.
void change_commands(Dice& dice, Case& c) {
  if (c.commands.empty() || dice.chance(0.2)) {
    c.commands.clear();
    c.attacker = dice.bits();
    return;
  }
  const auto all = static_cast<int>(c.commands.size());
  const int first = dice.index(all), last = std::min(all, first + 1 + dice.index(all));
  const double share = dice.chance(0.3) ? -1 : dice.log_uniform(0.2, 4);
  const int how = dice.index(4);
  if (how == 0) {
    const double stretch = dice.log_uniform(0.5, 2);
    for (guard::Command& command : c.commands) command.t_s *= stretch;
    return;
  }
  for (int i = first; i < last; ++i) {
    guard::Twist& twist = c.commands[static_cast<std::size_t>(i)].twist;
    if (how != 1) twist.turning_radps *= share;
    if (how != 2) twist.forward_mps *= share;
  }
}

/// None if no draw keeps the premise.
void draw_kept_events(Dice& dice, Scenario& s) {
  for (int i = 0; i < 5; ++i) {
    draw_events(dice, s);
    if (holds_premise(s)) return;
  }
  s.events.clear();
}

void change_one(Dice& dice, Case& c) {
  Scenario& s = c.scenario;
  switch (dice.index(9)) {
    case 0:
    case 1: change_keys(dice, s.robot, 1 + dice.index(3)); return;
    case 2:
    case 3: return change_world(dice, s);
    case 4: draw_truth(dice, s); return draw_wheels(dice, s);
    case 5: c.gaps = dice.chance(0.5) ? 0 : dice.bits() >> 1; return;
    case 6: return dice.chance(0.3) ? s.events.clear() : draw_events(dice, s);
    default: break;
  }
  if (!c.planner) return change_commands(dice, c);
  const double radius = s.robot.body.radius.raw() * 1e-6;
  s.goal.at = dice.around(s.start.at, 2 * radius, 26 * radius);
}

}  // namespace

Drawn draw_case(std::uint64_t seed) {
  Dice dice(seed);
  Drawn drawn;
  Scenario& s = drawn.c.scenario;
  s.name = "hunt " + std::to_string(seed);
  do {
    drawn.robot = draw_robot(dice);
    s.robot = drawn.robot.params;
    s.discs.clear();
    s.walls.clear();
    s.polygons.clear();
    s.bounds.reset();
    s.start.at = {};
    s.seed = dice.bits() >> 2;
    drawn.world = draw_world(dice, s);
    draw_truth(dice, s);
  } while (!holds_premise(s));
  draw_driver(dice, drawn.c);
  set_time(dice, drawn.c);
  if (dice.chance(kEventful)) draw_kept_events(dice, s);
  keep_base_in_time(drawn.c);
  draw_wheels(dice, s);
  return drawn;
}

Drawn draw_fresh(std::uint64_t seed) {
  if (seed % 4 == 0) return draw_case(seed);
  Drawn drawn;
  drawn.c.part = parts()[(seed - seed / 4 - 1) % parts().size()].name;
  drawn.c.attacker = seed;
  return drawn;
}

Case changed(const Case& c, std::uint64_t seed) {
  constexpr int kTries = 20;
  Dice dice(seed);
  for (int i = 0; i < kTries; ++i) {
    Case other = c;
    for (int count = 1 + dice.index(3); count > 0; --count) change_one(dice, other);
    if (!holds_premise(other.scenario)) continue;
    if (!other.planner && other.scenario.robot.bumper.creep_speed != Speed{}) continue;
    keep_base_in_time(other);
    if (other.planner) other.scenario.time_limit_s = mission_time_s(other.scenario);
    return other;
  }
  return c;
}

}  // namespace whisker::hunt

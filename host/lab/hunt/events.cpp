#include "host/lab/hunt/events.hpp"

#include <algorithm>

#include "host/harness/scenario/param_list.hpp"
#include "host/lab/hunt/robots.hpp"

namespace whisker::hunt {
namespace {

/// Half of them as the world is, the others off by a little or by a lot.
void draw_pose(Dice& dice, const Scenario& s, Event& e) {
  if (dice.chance(0.5)) return;
  const double radius = s.robot.body.radius.raw() * 1e-6;
  const sim::Vec2 at = dice.around(s.start.at, 1e-3 * radius, 20 * radius);
  e.x_m = at.x;
  e.y_m = at.y;
  if (dice.chance(0.7)) e.heading_deg = dice.uniform(-180, 180);
}

void draw_param(Dice& dice, const Scenario& s, Event& e) {
  Params changed = s.robot;
  e.kind = EventKind::restart;
  if (change_keys(dice, changed, 1).accepted == 0) return;
  const std::vector<ParamEntry> before = param_list(s.robot), after = param_list(changed);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].raw == after[i].raw || is_fixed_in_a_run(before[i].key)) continue;
    e.kind = EventKind::param;
    e.param = i;
    e.raw = after[i].raw;
  }
}

void draw_event(Dice& dice, const Scenario& s, Event& e) {
  e.kind = static_cast<EventKind>(dice.index(kEventKinds));
  const double radius = s.robot.body.radius.raw() * 1e-6;
  switch (e.kind) {
    case EventKind::goal:
      e.goal = {dice.around(s.start.at, 0.1 * radius, 26 * radius), dice.log_uniform(0.1, 2) * radius};
      return;
    case EventKind::correct:
      draw_pose(dice, s, e);
      if (dice.chance(0.7)) e.sigma_m = dice.log_uniform(1e-4, 1);
      if (dice.chance(0.7)) e.sigma_deg = dice.log_uniform(0.01, 45);
      return;
    case EventKind::place: return draw_pose(dice, s, e);
    case EventKind::frames_lost: e.for_s = dice.log_uniform(0.01, 3); return;
    case EventKind::param: return draw_param(dice, s, e);
    default: return;
  }
}

}  // namespace

void draw_events(Dice& dice, Scenario& s) {
  s.events.clear();
  for (int i = 1 + dice.index(6); i > 0; --i) {
    Event e;
    e.t_s = dice.chance(0.3) ? dice.log_uniform(0.01, 1) : dice.uniform(0, s.time_limit_s);
    draw_event(dice, s, e);
    s.events.push_back(e);
    // Parameters count from the next start on.
    if (e.kind != EventKind::param || dice.chance(0.2)) continue;
    e.kind = EventKind::restart;
    e.t_s += dice.log_uniform(0.01, 5);
    s.events.push_back(e);
  }
  std::sort(s.events.begin(), s.events.end(), [](const Event& a, const Event& b) { return a.t_s < b.t_s; });
}

std::vector<Params> robots_of(const Scenario& s) {
  std::vector<Params> robots = {s.robot};
  Params next = s.robot;
  for (const Event& e : s.events) {
    if (e.kind == EventKind::param && apply_param(e, next)) robots.push_back(next);
  }
  return robots;
}

}  // namespace whisker::hunt

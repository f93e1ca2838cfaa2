// Parts of the planners on ground that is made by hand.
#include <algorithm>
#include <cmath>

#include "firmware/planning/boundary/follow_side_search.hpp"
#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/scan_behaviour.hpp"
#include "firmware/planning/thesis/step_probe.hpp"
#include "firmware/planning/thesis/surroundings.hpp"
#include "firmware/planning/thesis/thesis_planner.hpp"
#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using perception::Echoes;
using perception::Validity;
using planning::View;

double degrees(Angle a) { return radians(a) * 180 / sim::kPi; }
Angle angle(double deg) {
  return Angle::from_raw(static_cast<std::uint32_t>(std::llround(deg / 360 * 0x1p32)));
}

Echoes echoes(int left_mm, int front_mm, int right_mm) {
  Echoes e;
  const int mm[] = {left_mm, front_mm, right_mm};
  for (int i = 0; i < 3; ++i)
    e.beam[i] = {millimetres(mm[i]), mm[i] == 2000 ? Validity::clear : Validity::ok};
  return e;
}

struct Ground {
  Params p;
  perception::LocalGrid grid;
  Pose pose;
  explicit Ground(Dice& dice) : pose(draw_pose(dice)) {
    grid.configure(p);
    grid.reset(pose);
  }
  void mark(Angle direction, Length reach, bool hit, bool aimed = false) {
    perception::ConeObservation seen;
    seen.beam = perception::beam_of(mount(p.rangefinders, hal::kFront), {pose.at, direction});
    seen.free = reach;
    seen.hit = hit;
    seen.aimed = aimed;
    grid.mark(seen);
  }
  void see(double from_deg, double to_deg, Length reach, bool hit) {
    for (double deg = from_deg; deg <= to_deg; deg += 3) mark(angle(deg), reach, hit);
  }
  View view(Angle heading) const {
    View v;
    v.pose = {pose.at, heading};
    v.static_scan = v.moving_scan = echoes(2000, 2000, 2000);
    v.sighted = true;
    v.local_grid = &grid;
    v.granted = Q14::ratio(1, 1);
    v.elapsed = p.safety.period;
    return v;
  }
};

/// Ways by what lies in them, and the turn that brings a beam onto what nobody has seen.
std::string judge_ways(Dice& dice) {
  Ground g(dice);
  const double clear = dice.uniform(60, 170);
  g.see(-clear, clear, 500_mm, false);
  if (dice.chance(0.5)) {
    const double to = dice.uniform(-170, 170);
    g.see(to - 6, to + 6, 150_mm, true);
  }
  const Reach& reach = g.grid.reach();
  for (int i = 0; i < 12; ++i) {
    const Angle heading = draw_angle(dice), from = draw_angle(dice);
    const View v = g.view(from);
    const perception::Obstacles o = g.grid.along(g.pose.at, heading, reach.probe, reach.planning);
    const planning::Way way = planning::way(v, heading, reach.probe, reach.planning);
    const planning::Way due = o.suspect > 0   ? planning::Way::occupied
                              : o.unknown > 0 ? planning::Way::unknown
                                              : planning::Way::free;
    if (way != due) return "another kind of way";
    const planning::Unseen rest = planning::unseen(v, heading, reach.probe, from, g.p);
    if (rest.cells != (o.suspect > 0 ? 0 : o.unknown)) return "another number of unseen cells";
    if (rest.cells == 0) continue;
    double least = 1e9;
    for (int beam = 0; beam < 3; ++beam) {
      const Angle needed = bearing(o.nearest_unknown) - from - beam_axis(g.p.rangefinders, beam);
      least = std::min(least, std::fabs(radians(needed)));
    }
    if (std::fabs(std::fabs(radians(rest.turn)) - least) > 1e-4) return "another beam would see it sooner";
  }
  return "";
}

/// A scan ends when it knows whether the way is free.
std::string judge_scan(Dice& dice) {
  Ground g(dice);
  const Angle along = draw_angle(dice);
  const bool pole = dice.chance(0.5), nothing = !pole && dice.chance(0.3);
  Angle heading = draw_angle(dice);
  planning::ScanBehaviour scan;
  planning::Manoeuvre m;
  scan.begin(along, g.grid.reach().probe, m);
  if (m.kind != planning::ManoeuvreKind::stop) return "a scan does not stop first";
  bool over = false;
  int ticks = 0;
  for (; ticks < 800 && !over; ++ticks) {
    const bool turns = m.kind == planning::ManoeuvreKind::cruise;
    if (m.forward != Speed{}) return "a scan drives";
    if (turns) heading += angle_of(m.turning * g.p.safety.period, g.p.body.track / 2);
    for (int beam = 0; beam < 3; ++beam) {
      const Angle axis = heading + beam_axis(g.p.rangefinders, beam);
      const bool hit = pole && std::fabs(radians(axis - along)) < 12 * sim::kPi / 180;
      g.mark(axis, hit ? 150_mm : nothing ? 100_mm : 500_mm, hit, !turns);
    }
    m.kind = turns ? planning::ManoeuvreKind::cruise : planning::ManoeuvreKind::keep;
    over = scan.step(g.view(heading), g.p, m);
  }
  const Reach& reach = g.grid.reach();
  const planning::Way way = planning::way(g.view(heading), along, reach.probe, reach.planning);
  if (!over) return "a scan does not end";
  if (ticks > 620) return "a scan takes too long";
  const planning::Way due = pole || nothing ? planning::Way::occupied : planning::Way::free;
  return way == due ? "" : "a scan ends without knowing";
}

/// From a blocked direction to both sides; the smaller turn wins, whichever came first.
std::string judge_sides(Dice& dice) {
  Ground g(dice);
  const double right = -dice.uniform(30, 75), left = dice.uniform(30, 75);
  // Each turn is known to a cell at the echoes, 7.5 degrees, and a candidate.
  if (std::fabs(left + right) < 18) return "";
  const auto shown = [&](double deg) { return deg >= right - 12.5 && deg <= left + 12.5; };
  const Angle target = draw_angle(dice);
  g.see(degrees(target) + 120, degrees(target) + 240, 300_mm, false);
  planning::FollowSideSearch search;
  const bool both = dice.chance(0.7);
  const planning::Side first = dice.chance(0.5) ? planning::Side::left : planning::Side::right;
  if (both) search.begin(target, first);
  if (!both) search.begin_on(target, first);
  Angle heading = target;
  double leftmost = 0, rightmost = 0;
  bool over = false;
  for (int i = 0; i < 2500 && !over; ++i) {
    for (int beam = 0; beam < 3; ++beam) {
      const Angle axis = heading + beam_axis(g.p.rangefinders, beam);
      const bool hit = shown(degrees(axis - target));
      g.mark(axis, hit ? 150_mm : 2_m, hit);
    }
    View view = g.view(heading);
    view.moving_scan.beam[hal::kFront].distance = shown(degrees(heading - target)) ? 150_mm : 2_m;
    planning::Twist twist;
    over = search.step(view, twist);
    if (twist.forward != Speed{}) return "a search drives";
    heading += angle_of(twist.turning * (100_mm) * milliseconds(20), 100_mm);
    leftmost = std::max(leftmost, degrees(heading - target));
    rightmost = std::min(rightmost, degrees(heading - target));
  }
  if (!over) return "a search does not end";
  if (!search.found()) return "a search finds no side";
  const planning::Side due = !both ? first : left < -right ? planning::Side::left : planning::Side::right;
  if (search.side() != due) return "a search takes the larger turn";
  const double off = degrees(search.heading() - target), edge = due == planning::Side::left ? left : -right;
  const double turned = due == planning::Side::left ? off : -off;
  if (turned < edge || turned > edge + 90) return "a search takes another heading";
  if (!both && (first == planning::Side::left ? rightmost < -2 : leftmost > 2))
    return "a search turns to the other side";
  const Reach& reach = g.grid.reach();
  return planning::way(g.view(heading), search.heading(), reach.probe, reach.planning) == planning::Way::free
             ? ""
             : "a search takes a way that is not free";
}

/// Whether the arcs of three echoes leave room for a step.
std::string judge_probe(Dice& dice) {
  Params p;
  if (dice.chance(0.5)) p.rangefinders.offset = millimetres(dice.index(60));
  planning::StepProbe probe;
  probe.configure(p);
  const double wide = metres(p.body.radius + p.body.margin);
  for (int i = 0; i < 8; ++i) {
    const double step = 0.02 + dice.uniform(0, 0.38);
    Echoes look = echoes(2000, 2000, 2000);
    double gap = 1e9;
    for (int beam = 0; beam < 3; ++beam) {
      if (dice.chance(0.4)) continue;
      const int mm = 30 + dice.index(700);
      look.beam[beam] = {millimetres(mm), Validity::ok};
      const Mount m = mount(p.rangefinders, beam);
      for (int k = 0; k <= 400; ++k) {
        const double a = radians(m.axis) + radians(m.half_cone) * (k / 200.0 - 1);
        const double x = metres(m.apex.x) + mm * 1e-3 * std::cos(a),
                     y = metres(m.apex.y) + mm * 1e-3 * std::sin(a);
        gap = std::min(gap, std::hypot(x - std::clamp(x, 0.0, step), y));
      }
    }
    const bool free = probe.free(look, micrometres(static_cast<std::int32_t>(step * 1e6)));
    if (std::fabs(gap - wide) > 1e-4 && free != (gap > wide)) return "a step has room or none";
    look.beam[dice.index(3)] = {Length{}, dice.chance(0.5) ? Validity::stale : Validity::too_near};
    if (probe.free(look, 100_mm)) return "an unusable beam leaves room";
  }
  return "";
}

/// What several scans at one place leave of a way.
std::string judge_ring(Dice& dice) {
  Params p;
  if (dice.chance(0.5)) p.rangefinders.offset = millimetres(dice.index(60));
  planning::Surroundings ring;
  ring.configure(p);
  // In sectors of 5 degrees: what a cone surely covers, and what it may.
  std::vector<double> surely(360, 0), perhaps(360, 0);
  const double radius = metres(p.body.radius);
  for (int i = 1 + dice.index(3); i > 0; --i) {
    const int mm[] = {80 + dice.index(500), 80 + dice.index(500), 80 + dice.index(500)};
    // Not where a sector just ends.
    const Angle heading = Angle::turns(4 * dice.index(360) + 1, 1440);
    ring.add(echoes(mm[0], mm[1], mm[2]), heading);
    for (int beam = 0; beam < 3; ++beam) {
      const Mount m = mount(p.rangefinders, beam);
      const double out = metres(norm(m.apex)),
                   half = degrees(m.half_cone) -
                          std::asin(std::min(1.0, out * std::sin(radians(m.half_cone)) / radius)) * 180 /
                              sim::kPi;
      for (std::size_t d = 0; d < 360; ++d) {
        const double off = std::fabs(std::remainder(static_cast<double>(d) - degrees(heading + m.axis), 360));
        const double far = mm[beam] * 1e-3 + out;
        if (off < half - 5.5) surely[d] = std::max(surely[d], far - out * 0.2);
        if (off < half + 5.5) perhaps[d] = std::max(perhaps[d], far);
      }
    }
  }
  const double wide = metres(p.body.radius + p.body.margin);
  for (int i = 0; i < 10; ++i) {
    const int way = dice.index(360);
    const double step = 0.05 + dice.uniform(0, 0.2);
    const Length length = micrometres(static_cast<std::int32_t>(step * 1e6));
    const bool allowed = ring.allow(Angle::turns(way, 360), length);
    bool blocked = false, may_block = false;
    for (std::size_t d = 0; d < 360; ++d) {
      const double off = std::remainder(static_cast<double>(d) - way, 360) * sim::kPi / 180;
      const auto near = [&](double far, double slack) {
        const double x = far * std::cos(off), y = far * std::sin(off);
        return std::hypot(x - std::clamp(x, 0.0, step), y) < wide + slack;
      };
      const bool ahead = std::fabs(off) < sim::kPi / 2 - 0.1;
      // Only a sector that nothing else covers farther.
      blocked = blocked || (ahead && surely[d] > 0 && near(perhaps[d], -0.03));
      may_block = may_block || (std::fabs(off) < sim::kPi / 2 + 0.1 && perhaps[d] > 0 &&
                                near(surely[d] > 0 ? surely[d] : 0.0, 0.03));
    }
    if (allowed && blocked) return "a way through an echo";
    if (!allowed && !may_block) return "a way is refused without an echo";
  }
  return "";
}

/// The thesis's steps: to the goal in the open, turned away from what is nearer, and the end of it.
std::string judge_steps(Dice& dice) {
  const Params p;
  planning::ThesisPlanner planner(p, fuzzy::kDefaultTable);
  const Pose start = {{millimetres(dice.index(2000)), millimetres(dice.index(2000))}, draw_angle(dice)};
  const double far = dice.uniform(0.5, 3), to = dice.uniform(-sim::kPi, sim::kPi);
  const Vec goal =
      start.at + polar(angle(to * 180 / sim::kPi), micrometres(static_cast<std::int32_t>(far * 1e6)));
  planner.set_goal({goal, 100_mm});
  Pose pose = start;
  int left = 700 + dice.index(600), right = 700 + dice.index(600);
  const int front = dice.chance(0.5) ? 2000 : 900 + dice.index(300);
  planning::Decision d;
  bool faced = false;
  for (int i = 0; i < 200; ++i) {
    View view;
    view.pose = pose;
    view.static_scan = echoes(left, front, right);
    d = planner.step(view);
    if (d.outcome != planning::Outcome::running) break;
    if (d.manoeuvre.kind == planning::ManoeuvreKind::turn) {
      if (!faced && std::fabs(radians(d.manoeuvre.heading) - to) > 1e-3 &&
          std::fabs(std::fabs(radians(d.manoeuvre.heading) - to) - 2 * sim::kPi) > 1e-3)
        return "it does not face the goal first";
      faced = true;
      pose.heading = d.manoeuvre.heading;
    }
    if (d.manoeuvre.kind == planning::ManoeuvreKind::drive) {
      const double before = metres(norm(goal - pose.at));
      const Angle bearing_of_goal = bearing(goal - pose.at);
      const double turned = radians(d.manoeuvre.heading - bearing_of_goal);
      if (left < right && turned > 1e-3) return "a step turns towards what is nearer";
      if (left > right && turned < -1e-3) return "a step turns towards what is nearer";
      if (metres(d.manoeuvre.length) > before + 1e-3 || d.manoeuvre.length > 400_mm)
        return "a step beyond the goal";
      pose.at = pose.at + polar(d.manoeuvre.heading, d.manoeuvre.length);
      pose.heading = d.manoeuvre.heading;
      if (metres(norm(goal - pose.at)) > before) return "a step away from the goal";
    }
  }
  if (d.outcome != planning::Outcome::reached || d.why != planning::Why::at_goal)
    return "steps do not reach the goal";
  return metres(norm(goal - pose.at)) <= 0.1 ? "" : "steps end elsewhere";
}

}  // namespace

std::string judge_planners(Dice& dice) {
  for (const JudgePart judge : {judge_ways, judge_scan, judge_sides, judge_probe, judge_ring, judge_steps}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt

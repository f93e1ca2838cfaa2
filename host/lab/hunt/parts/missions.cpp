// Whole missions of a body that does what it says, in worlds whose outcome is known beforehand.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "firmware/robot.hpp"
#include "host/harness/run/narrowest_gap.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/body.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using planning::Outcome;
using planning::Why;
using sim::Vec2;

constexpr double kContact_m = 1e-4;  // of the integration of a millisecond

struct Trip {
  Params p;
  Body body;
  std::shared_ptr<planning::Planner> planner;
  Robot robot;
  std::uint32_t now;
  double time_s = 0, path_m = 0, turned = 0, least_gap_m = 1e9;
  std::string wrong;
  sim::Pose start;
  double tolerance_m = 0.1;
  Vec2 goal;

  Trip(Dice& dice, PlannerKind kind, const Params& params, Clutter world = {})
      : p(params),
        body(p, std::move(world), {{0, 0}, dice.uniform(-3, 3)}),
        planner(make_planner(kind, p)),
        robot(body, body, *planner, p, &body) {
    now = dice.chance(0.3) ? 0xFFFFF800U : static_cast<std::uint32_t>(dice.index(100000));
    start = body.pose();
    robot.place(fixed_pose(start));
  }
  Trip(const Trip&) = delete;
  Trip& operator=(const Trip&) = delete;

  void set_goal(Vec2 at, double tolerance = 0.1) {
    goal = at;
    tolerance_m = tolerance;
    if (!robot.set_goal(
            {fixed_pose({at, 0}).at, Length::from_raw(static_cast<std::int32_t>(tolerance * 1e6))}))
      wrong = "a goal is refused";
  }
  const Status& tick() {
    const sim::Pose before = body.pose();
    body.pass(p.safety.period.raw());
    now += static_cast<std::uint32_t>(p.safety.period.raw());
    const Status& s = robot.tick(Time::from_raw(now));
    time_s += p.safety.period.raw() * 1e-3;
    path_m += length_of(body.pose().at - before.at);
    turned += std::fabs(body.pose().heading - before.heading);
    least_gap_m = std::min(least_gap_m, body.gap_m());
    if (least_gap_m < -kContact_m) wrong = "a mission touches something";
    if (s.health.fault != Fault::none) wrong = "a mission ends with a fault";
    return s;
  }
  /// Until the verdict, or what is wrong.
  Outcome run(double most_s) {
    const double until = time_s + most_s;
    while (time_s < until && wrong.empty()) {
      const Outcome o = tick().decision.outcome;
      if (o >= Outcome::reached) return o;
    }
    return Outcome::running;
  }
  double left_m() const { return length_of(goal - body.pose().at); }
  /// Within the tolerance, but for what the counts leave.
  std::string arrives(double most_s, double most_m) {
    const double from_s = time_s, from_m = path_m;
    const Outcome o = run(most_s);
    if (!wrong.empty()) return wrong;
    if (o != Outcome::reached)
      return o == Outcome::running ? "a mission takes too long" : "a mission gives up";
    const double counts = 2.0 / p.wheels.counts_per_metre / metres(p.body.track) * (path_m + 1);
    if (left_m() > tolerance_m + counts + 0.004) return "it arrives elsewhere";
    static_cast<void>(from_s);
    return path_m - from_m > most_m ? "a mission takes a detour" : "";
  }
  double speed() const { return p.wheels.max_speed.raw() * 1e-6; }
};

PlannerKind draw_kind(Dice& dice, bool thesis = true) {
  const double which = dice.uniform(0, 1);
  return which < 0.45              ? PlannerKind::map
         : which < 0.85 || !thesis ? PlannerKind::boundary
                                   : PlannerKind::thesis;
}

Vec2 towards(double angle) { return {std::cos(angle), std::sin(angle)}; }
void wall(Clutter& world, Vec2 a, Vec2 b) { world.segments.push_back({a, b}); }
void box(Clutter& world, Vec2 centre, double half) {
  const Vec2 c[] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  for (int i = 0; i < 4; ++i) wall(world, centre + c[i], centre + c[(i + 1) % 4]);
}

struct Door {
  double x, y, width;
};

/// A closed room from `back` to `end`, 2 `half` wide, with a wall across it that has this door.
template <class Place>
void room_with_door(Clutter& world, const Place& place, double back, double end, double half, Door door) {
  const Vec2 corners[] = {place(back, -half), place(end, -half), place(end, half), place(back, half)};
  for (int i = 0; i < 4; ++i) wall(world, corners[i], corners[(i + 1) % 4]);
  wall(world, place(door.x, -half), place(door.x, door.y - door.width / 2));
  wall(world, place(door.x, door.y + door.width / 2), place(door.x, half));
}

/// One goal after another in the open, some of them called off.
std::string judge_open(Dice& dice) {
  Params p;
  if (dice.chance(0.3)) p.rangefinders.cone = 40_deg;
  const PlannerKind kind = draw_kind(dice);
  Trip t(dice, kind, p);
  for (int i = 0; i < 3; ++i) {
    const double distance = dice.uniform(0.3, 3);
    const Vec2 from = t.body.pose().at;
    t.set_goal(from + towards(dice.uniform(-3.2, 3.2)) * distance, dice.uniform(0.03, 0.2));
    if (dice.chance(0.2)) {
      const double until = t.time_s + dice.uniform(0.2, 12);
      while (t.time_s < until && t.tick().decision.outcome < Outcome::reached) {
      }
      t.robot.cancel();
      for (int k = 0; k < 120; ++k) t.tick();
      if (t.robot.status().decision.outcome != Outcome::none) return "a cancelled mission runs";
      if (!t.body.stands()) return "a cancelled mission drives";
      if (!t.wrong.empty()) return t.wrong;
      continue;
    }
    const bool steps = kind == PlannerKind::thesis;
    const std::string wrong = t.arrives(steps ? 18 + 15 * distance : 9 + 4 * distance, distance * 1.1 + 0.06);
    if (!wrong.empty()) return wrong;
    // It stays there.
    const Vec2 there = t.body.pose().at;
    for (int k = 0; k < 100; ++k) t.tick();
    if (length_of(t.body.pose().at - there) > 0.05 || !t.body.stands()) return "it leaves its goal";
  }
  return t.wrong;
}

/// Round one obstacle.
std::string judge_round(Dice& dice) {
  const PlannerKind kind = draw_kind(dice, false);
  Trip t(dice, kind, Params{});
  const double way = dice.uniform(-3.2, 3.2), far = dice.uniform(0.5, 1.2), behind = dice.uniform(0.4, 1);
  double round = 0;
  if (dice.chance(0.5)) {
    const double radius = dice.log_uniform(0.005, 0.4);
    const Vec2 beside = towards(way + sim::kPi / 2) * dice.uniform(-0.8, 0.8) * radius;
    t.body.world.discs = {{towards(way) * (far + radius) + beside, radius}};
    t.set_goal(towards(way) * (far + 2 * radius + behind));
    round = 2 * radius;
  } else {
    const double left = dice.uniform(0.05, 0.7), right = dice.uniform(0.05, 0.7);
    const Vec2 across = towards(way + sim::kPi / 2 + dice.uniform(-0.6, 0.6));
    const Vec2 middle = towards(way) * far;
    wall(t.body.world, middle + across * left, middle - across * right);
    t.set_goal(towards(way) * (far + behind));
    round = left + right;
  }
  if (t.body.gap_m() < 0.03 || t.body.world.distance(t.goal) < 0.2) return "";
  const double straight = length_of(t.goal);
  return t.arrives(28 + 7 * (straight + round), 1.2 * straight + 1.6 * round + 0.6);
}

/// A door in the only wall between start and goal, as narrow as the planners promise to pass, or wider.
std::string judge_door(Dice& dice) {
  const PlannerKind kind = draw_kind(dice, false);
  Trip t(dice, kind, Params{});
  const double narrowest = narrowest_gap_m(t.p),
               width = narrowest * (dice.chance(0.6) ? dice.uniform(1.01, 1.1) : dice.uniform(1.1, 2));
  const double turn = dice.uniform(-3.2, 3.2), half = dice.uniform(0.8, 1.3),
               at = dice.uniform(-0.6, 0.6) * half;
  const Vec2 ahead = towards(turn), left{-ahead.y, ahead.x};
  const auto place = [&](double x, double y) { return ahead * x + left * y; };
  const double door_x = dice.uniform(0.4, 0.7), end_x = door_x + dice.uniform(0.7, 1.2);
  room_with_door(t.body.world, place, -0.5, end_x, half, {door_x, at, width});
  t.set_goal(place(end_x - dice.uniform(0.25, 0.4), dice.uniform(-0.6, 0.6) * half));
  return t.arrives(160, 20);
}

/// Doors straight ahead that look closed to the local grid, some of them narrower than promised: the robot
/// measures them, and passes most of them at the first approach.
std::string judge_straight_doors(Dice& dice) {
  constexpr int kDoors = 6;
  const PlannerKind kind = draw_kind(dice, false);
  double all_s = 0;
  for (int i = 0; i < kDoors; ++i) {
    Trip t(dice, kind, Params{});
    const double width = dice.uniform(0.88, 1.08) * narrowest_gap_m(t.p), turn = dice.uniform(-0.15, 0.15);
    const Vec2 ahead = towards(t.start.heading + turn), left{-ahead.y, ahead.x};
    const auto place = [&](double x, double y) { return ahead * x + left * y; };
    const double door = dice.uniform(1, 2), aside = dice.uniform(-0.04, 0.04);
    room_with_door(t.body.world, place, -1, door + 2, 2, {door, aside, width});
    t.set_goal(place(door + 1, aside));
    const std::string wrong = t.arrives(400, 60);
    if (!wrong.empty()) return wrong;
    all_s += t.time_s;
  }
  return all_s / kDoors > 200 ? "doors are passed late" : "";
}

/// In a dead end, and out of it.
std::string judge_trap(Dice& dice) {
  const PlannerKind kind = draw_kind(dice, false);
  Trip t(dice, kind, Params{});
  const double turn = dice.uniform(-3.2, 3.2), half = dice.uniform(0.35, 0.7), depth = dice.uniform(0.4, 1.2),
               floor = dice.uniform(0.35, 0.6);
  const Vec2 ahead = towards(turn), left{-ahead.y, ahead.x};
  const auto place = [&](double x, double y) { return ahead * x + left * y; };
  Clutter& w = t.body.world;
  wall(w, place(floor - depth, -half), place(floor, -half));
  wall(w, place(floor, -half), place(floor, half));
  wall(w, place(floor, half), place(floor - depth, half));
  t.set_goal(place(floor + dice.uniform(0.3, 1), dice.uniform(-0.5, 0.5) * half));
  return t.arrives(65, 1.3 * (2 * depth + 2 * half + length_of(t.goal)) + 1);
}

/// A goal that is shut in, or a start.
std::string judge_closed(Dice& dice) {
  const PlannerKind kind = draw_kind(dice, false);
  Trip t(dice, kind, Params{});
  const double half = dice.uniform(0.3, 0.7);
  t.set_goal(towards(dice.uniform(-3.2, 3.2)) * (half * 1.5 + dice.uniform(0.5, 1)));
  box(t.body.world, dice.chance(0.7) ? t.goal : Vec2{0, 0}, half);
  if (t.body.gap_m() < 0.05) return "";
  const Outcome o = t.run(350);
  if (!t.wrong.empty()) return t.wrong;
  if (o == Outcome::reached) return "it is where it cannot be";
  if (o == Outcome::running) return "it never says that there is no way";
  return o == Outcome::unreachable ? "" : "it gives up where there is no way";
}

/// A bump switch is pressed on the way.
std::string judge_bump(Dice& dice) {
  Params p;
  p.bumper.fitted = Fitted::yes;
  Trip t(dice, draw_kind(dice, false), p);
  const double distance = dice.uniform(1.5, 3);
  t.set_goal(towards(dice.uniform(-3.2, 3.2)) * distance);
  const double begins = dice.uniform(0.3, 0.6) * distance;
  while (t.wrong.empty() && t.time_s < 60 && length_of(t.body.pose().at) < begins) t.tick();
  if (!t.wrong.empty()) return t.wrong;
  const Vec2 there = t.body.pose().at;
  t.body.pressed = static_cast<std::uint8_t>(1U << static_cast<unsigned>(dice.index(3)));
  const Status& s = t.tick();
  if (s.command.left != 0 || s.command.right != 0) return "a press does not stop the wheels at once";
  if (s.decision.why != Why::bumped || s.pressed != t.body.pressed) return "a press is not said";
  if (s.health.bumps != 1) return "a press is not counted once";
  for (int i = dice.index(20); i > 0; --i) t.tick();
  if (!dice.chance(0.2)) t.body.pressed = 0;
  double back = 0, fastest = 0;
  int ms = 0;
  for (; t.robot.status().decision.why == Why::bumped && ms < 9000; ms += 10) {
    t.tick();
    back = std::max(back, length_of(t.body.pose().at - there));
    fastest = std::min(fastest, (t.body.commanded.left + t.body.commanded.right) / 2e4);
    if (back > 0.02) t.body.pressed = 0;
  }
  if (!t.wrong.empty()) return t.wrong;
  if (ms >= 9000) return "it never goes on after a press";
  const double due = metres(p.body.radius) / 2;
  if (std::fabs(fastest + t.speed() / 4) > 0.005) return "it backs off at another speed";
  if (back < due - 0.02 || back > due + 0.08) return "it backs off by another length";
  return t.arrives(15 + 4 * distance, distance + 0.8);
}

/// The core pauses while the wheels brake, and begins anew.
std::string judge_reset(Dice& dice) {
  Trip t(dice, draw_kind(dice, false), Params{});
  const double distance = dice.uniform(1.5, 3);
  t.set_goal(towards(dice.uniform(-3.2, 3.2)) * distance);
  while (t.wrong.empty() && t.time_s < 60 && length_of(t.body.pose().at) < 0.4 * distance) t.tick();
  if (!t.wrong.empty()) return t.wrong;
  const sim::Pose before = t.body.pose();
  for (const double share : {0.75, 0.5, 0.25, 0.0}) {
    const hal::WheelSpeeds now = t.body.commanded;
    t.body.command(
        {static_cast<std::int16_t>(now.left * share), static_cast<std::int16_t>(now.right * share)});
    t.body.pass(60 + dice.index(20));
  }
  t.now += 300;
  t.robot.reset();
  if (t.robot.status().health.fault != Fault::none) return "a reset makes a fault";
  t.tick();
  if (!t.wrong.empty()) return t.wrong;
  const Pose pose = t.robot.status().pose;
  if (length_of(vec(pose.at) - t.body.pose().at) > 0.03 || length_of(before.at - t.body.pose().at) < 0.005)
    return "a pause loses the way";
  if (t.robot.status().decision.outcome == Outcome::running) return "a mission goes on after a reset";
  t.set_goal(t.goal);
  return t.arrives(15 + 4 * distance, 1.1 * distance + 0.5);
}

/// Corrections on the way do not lose the goal.
std::string judge_fixes(Dice& dice) {
  Trip t(dice, draw_kind(dice, false), Params{});
  const double distance = dice.uniform(1, 2.5);
  t.set_goal(towards(dice.uniform(-3.2, 3.2)) * distance, 0.15);
  // The user's frame is off by this from then on; what is told is true in it.
  for (int i = 0; i < 3; ++i) {
    for (int k = 20 + dice.index(200); k > 0 && t.wrong.empty(); --k) {
      if (t.tick().decision.outcome >= Outcome::reached) return t.wrong;
    }
    const bool corrects = dice.chance(0.5);
    sim::Pose told = t.body.pose();
    // At the counts of the last tick.
    if (corrects && !t.robot.correct(fixed_pose(told), fixed_sigma(0.001, 0.001))) return "a fix is refused";
    if (!corrects && !t.robot.place(fixed_pose(told))) return "a place is refused";
    const Pose now = t.robot.status().pose;
    static_cast<void>(now);
  }
  return t.arrives(15 + 4 * distance, 1.1 * distance + 0.8);
}

}  // namespace

std::string judge_missions(Dice& dice) {
  constexpr JudgePart kJudges[] = {judge_open,   judge_round, judge_round, judge_door, judge_trap,
                                   judge_closed, judge_bump,  judge_fixes, judge_reset};
  for (int i = 0; i < 4; ++i) {
    std::string wrong = kJudges[dice.index(9)](dice);
    if (!wrong.empty()) return wrong;
  }
  return dice.chance(0.25) ? judge_straight_doors(dice) : "";
}

}  // namespace whisker::hunt

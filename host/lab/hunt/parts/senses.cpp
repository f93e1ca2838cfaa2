// What perception hands on: the map of clear ground, lanes, touches, and whether something moved.
#include <cmath>

#include "firmware/perception/contacts.hpp"
#include "firmware/perception/incidence_watch.hpp"
#include "firmware/perception/motion_detector.hpp"
#include "firmware/perception/range_monitor.hpp"
#include "host/lab/hunt/parts/grid_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"
#include "host/lab/hunt/parts/room.hpp"

namespace whisker::hunt {
namespace {

/// Cells of the map become free where all ground around their middle is clear, and nowhere else.
std::string judge_copy(Dice& dice) {
  Room room(draw_shape(dice), {}, {});
  room.scatter(dice, 0.3, 0.1);
  const Pose pose{{micrometres(dice.index(600000) - 300000), micrometres(dice.index(600000) - 300000)},
                  draw_angle(dice)};
  const LocalGrid grid = draw_grid(dice, room.params, pose);
  std::vector<planning::CellState> before;
  room.each([&](planning::Cell p) { before.push_back(room.map.at(p)); });
  const std::int32_t rows = room.map.reach_of(grid);
  for (std::int32_t row = -rows; row <= rows; ++row) room.map.free(grid, pose.at, row);
  std::string wrong;
  const double reach = metres(room.map.cell()) * 0.6, fine = metres(grid_cell(room.params));
  room.each([&](planning::Cell p) {
    const Vec middle = room.map.middle(p);
    const sim::Vec2 off = vec(middle) - vec(pose.at);
    bool clear = true, may_be = true;
    if (std::max(std::fabs(off.x), std::fabs(off.y)) > 0.6) {
      clear = may_be = false;
    } else {
      each_cell(middle, grid_cell(room.params), [&](Vec at) {
        const double far = Square::around(at, grid_cell(room.params)).nearest(vec(middle));
        if (grid.is_clear(at)) return;
        clear = clear && far > reach + 0.05 * fine;
        may_be = may_be && far > reach - 0.05 * fine;
      });
    }
    const planning::CellState now = room.map.at(p), then = before[room.index(p)];
    if (now != then && now != planning::CellState::free) wrong = "clear ground blocks";
    if (now != then && !may_be) wrong = "a cell of the map is free without clear ground";
    if (clear && std::max(std::fabs(off.x), std::fabs(off.y)) < 0.18 && now != planning::CellState::free)
      wrong = "clear ground does not free the map";
  });
  return wrong;
}

/// On a lane as in the grid: nothing stands on clear ground, and what a beam shows empty is clear.
std::string judge_lane(Dice& dice) {
  const Params p = draw_eyes(dice);
  const Pose pose = draw_pose(dice);
  const Clutter world = draw_clutter(dice, p, pose, metres(rim_sweep(p).radius) + 1e-4);
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  if (grid.lane().is_open()) return "a lane is open at first";
  const Pose from{pose.at, pose.heading + Angle::turns(dice.index(21) - 10, 360)};
  grid.open_lane(from);
  if (!grid.lane().is_open()) return "no lane is open";
  std::vector<ConeObservation> seen;
  for (int beam = 0; beam < 3; ++beam) {
    seen.push_back(look(p, world, pose, beam));
    grid.mark(seen.back());
  }
  const double half = metres(grid.lane().half_width()), cell = half / 8;
  const sim::Vec2 ahead{std::cos(radians(from.heading)), std::sin(radians(from.heading))},
      left{-ahead.y, ahead.x};
  for (int i = 0; i < 400; ++i) {
    const sim::Vec2 at = vec(from.at) + ahead * dice.uniform(0, 30 * cell) + left * dice.uniform(-half, half);
    const Vec fixed{Length::from_raw(static_cast<std::int32_t>(std::lround(at.x * 1e6))),
                    Length::from_raw(static_cast<std::int32_t>(std::lround(at.y * 1e6)))};
    const bool clear = grid.lane().is_clear(fixed);
    if (clear && world.distance(at) <= -1e-5) return "an obstacle stands on a clear lane";
    const Square around{at - sim::Vec2{1.5 * cell, 1.5 * cell}, at + sim::Vec2{1.5 * cell, 1.5 * cell}};
    if (clear) continue;
    for (const ConeObservation& o : seen) {
      if (empty_by(around, o.beam, o.free) > 0.1 * cell) return "a lane seen empty is not clear";
    }
  }
  const perception::Beam& beam = seen[1].beam;
  const Length far = p.body.radius * 20 / 9;
  grid.revoke(beam, far, far);
  grid.block(pose.at + polar(pose.heading, far), p.body.radius / 9);
  return grid.lane().is_open() ? "a touch leaves the lane open" : "";
}

std::string judge_contacts(Dice& dice) {
  perception::Contacts contacts;
  const Length radius = millimetres(40 + dice.index(200));
  contacts.configure(radius);
  if (contacts.radius() != radius / 3 || contacts.count() != 0) return "another disc of a touch";
  int kept = 0;
  for (int i = 0; i < 30; ++i) {
    const Pose body{{radius * 4 * i, radius * dice.index(3)}, draw_angle(dice)};
    const unsigned side = static_cast<unsigned>(dice.index(3));
    contacts.add(static_cast<std::uint8_t>(1U << side), body);
    kept = std::min(kept + 1, int{perception::Contacts::kKept});
    if (contacts.count() != kept) return "another number of touches";
    bool found = false;
    for (int n = 0; n < contacts.count(); ++n) {
      const Vec off = contacts.at(n) - body.at;
      const double far = metres(norm(off)) / metres(radius),
                   where = std::remainder(radians(bearing(off)) - radians(body.heading), 2 * sim::kPi);
      const bool there = side == 0 ? where > 0.2 : side == 2 ? where < -0.2 : std::fabs(where) < 0.2;
      found = found || (far > 0.9 && far < 1.7 && there && std::fabs(where) < 1.6);
    }
    if (!found) return "a touch lies elsewhere";
    contacts.add(static_cast<std::uint8_t>(1U << side), body);
    if (contacts.count() != kept) return "the same touch twice";
  }
  contacts.reset();
  return contacts.count() == 0 ? "" : "touches outlive a reset";
}

/// An echo from ground that was shown empty has moved there; one that was there before has not.
std::string judge_motion(Dice& dice) {
  const Params p;
  Mount mounts[3];
  for (int i = 0; i < 3; ++i) mounts[i] = mount(p.rangefinders, i);
  perception::MotionDetector detector;
  detector.configure(mounts);
  Pose pose = draw_pose(dice);
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  Time now = Time::from_raw(static_cast<std::uint32_t>(dice.bits()));
  const double far = dice.uniform(0.25, 0.45);
  const Length at = micrometres(static_cast<std::int32_t>(far * 1e6));
  const bool before = dice.chance(0.5);
  const perception::Beam echo = perception::beam_of(mounts[1], pose);
  if (detector.contradicts(echo, at, at, false, grid)) return "something moves before anything is seen";
  for (int i = 0; i < 8; ++i) {
    Pose from = pose;
    from.heading += Angle::turns(12 * (i % 5) - 24, 360);
    Length free[3];
    std::uint8_t hits = 0;
    for (int k = 0; k < 3; ++k) {
      const perception::Beam beam = perception::beam_of(mounts[k], from);
      const double off = std::fabs(radians(beam.axis - echo.axis));
      const bool sees = before && off < radians(beam.half_cone) + radians(echo.half_cone);
      free[k] = sees ? at : 700_mm;
      if (sees) hits = static_cast<std::uint8_t>(hits | 1U << static_cast<unsigned>(k));
    }
    detector.add(from, now, free, hits);
    now = now + 100_ms;
  }
  const bool moved = detector.contradicts(echo, at, at, false, grid);
  if (moved == before) return moved ? "a thing at rest moves" : "a thing that came is not noticed";
  detector.reset();
  return detector.contradicts(echo, at, at, false, grid) ? "a scan outlives a reset" : "";
}

/// Contradictions in a path, and what they cost.
std::string judge_trust(Dice& dice) {
  perception::RangeMonitor monitor;
  monitor.configure(Params{});
  monitor.reset();
  if (monitor.slows() || monitor.trust().level != RangeLevel::trusted) return "no trust at first";
  const double each_m = dice.uniform(0.15, 2);
  Vec at;
  monitor.move_to(at);
  double next = each_m;
  for (int mm = 0; mm < 16000; mm += 10) {
    at.x = millimetres(mm);
    monitor.move_to(at);
    if (mm * 1e-3 >= next) {
      monitor.contradict(false);
      next += each_m;
    }
    monitor.judge(0, 0);
  }
  const double rate = monitor.trust().contradictions / static_cast<double>(RangeTrust::kOnePerMetre),
               due = std::min(1 / each_m, 50.0);
  if (std::fabs(rate - due) > 0.35 + 0.4 * due) return "another rate of contradictions";
  if ((monitor.trust().level == RangeLevel::trusted) == monitor.contradicted()) return "a doubt and none";
  // They fade with the way.
  for (int mm = 0; mm < 40000; mm += 10) {
    at.x += 10_mm;
    monitor.move_to(at);
    monitor.judge(0, 0);
  }
  if (monitor.contradicted() || monitor.trust().level != RangeLevel::trusted) return "a doubt for ever";
  monitor.judge(0, 30000);
  return monitor.slows() && monitor.trust().false_clears == 30000 ? "" : "false clear readings cost nothing";
}

/// While the body turns past a wall, the incidence up to which it gives echoes.
std::string judge_incidence(Dice& dice) {
  const Params p;
  Mount mounts[3];
  for (int i = 0; i < 3; ++i) mounts[i] = mount(p.rangefinders, i);
  perception::IncidenceWatch watch;
  watch.reset();
  const double limit = dice.uniform(30, 70) * sim::kPi / 180, wall = dice.uniform(0.3, 0.6),
               step = dice.uniform(0.8, 1.8) * sim::kPi / 180;
  // Five readings that sweep less than 20 mm of the wall measure nothing.
  if (4 * step * wall < 0.0205) return "";
  Pose pose;
  for (int i = 0; i < 3000; ++i) {
    perception::SeenRange seen[3];
    for (int k = 0; k < 3; ++k) {
      // The nearest point of the wall in the cone.
      const double axis = std::remainder(radians(pose.heading + mounts[k].axis), 2 * sim::kPi);
      const double incidence = std::max(0.0, std::fabs(axis) - radians(mounts[k].half_cone));
      if (incidence < limit && std::fabs(axis) < sim::kPi / 2)
        seen[k].mm = static_cast<std::uint16_t>(std::lround(1000 * wall / std::cos(incidence)));
    }
    watch.add(pose, seen, mounts);
    pose.heading += Angle::from_raw(static_cast<std::uint32_t>(std::llround(step / (2 * sim::kPi) * 0x1p32)));
  }
  const double measured = watch.seen_deg(), due = limit * 180 / sim::kPi;
  return measured > due + 5 || measured < due - 35 ? "another incidence" : "";
}

}  // namespace

std::string judge_senses(Dice& dice) {
  for (const JudgePart judge :
       {judge_copy, judge_lane, judge_contacts, judge_motion, judge_trust, judge_incidence}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt

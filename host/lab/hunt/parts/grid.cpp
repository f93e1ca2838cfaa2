// What the local grid calls clear, against the obstacles and the beams that made it so.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using perception::ConeObservation;
using perception::LocalGrid;
using sim::Vec2;

/// How far all corners of the cell lie inside the empty sector.
double empty_by(const Square& cell, const perception::Beam& beam, Length free) {
  const Vec2 apex = vec(beam.apex);
  const double axis = radians(beam.axis), half = radians(beam.half_cone);
  double by = metres(free) - 0.001 - cell.farthest(apex);
  for (const double x : {cell.low.x, cell.high.x}) {
    for (const double y : {cell.low.y, cell.high.y}) {
      const Vec2 d = Vec2{x, y} - apex;
      by = std::min(by, d.x * std::sin(axis + half) - d.y * std::cos(axis + half));
      by = std::min(by, -d.x * std::sin(axis - half) + d.y * std::cos(axis - half));
    }
  }
  return by;
}

/// Cells beside which the window may end: it reaches 13 cells behind the body.
bool well_inside(const Params& p, const Pose& pose, Vec at) {
  const double cell = metres(grid_cell(p));
  const Vec2 ahead{std::cos(radians(pose.heading)), std::sin(radians(pose.heading))};
  const Vec2 off = vec(at) - (vec(pose.at) + ahead * (3 * cell));
  return std::max(std::fabs(off.x), std::fabs(off.y)) < 14 * cell;
}

bool is_under(const Params& p, const Pose& pose, Vec at) {
  return Square::around(at, grid_cell(p)).farthest(vec(pose.at)) <= metres(rim_sweep(p).radius);
}

/// A turn, or a way that covers nothing.
Pose draw_step(Dice& dice, const Params& p, const Clutter& world, const Pose& pose) {
  Pose next = pose;
  next.heading += Angle::from_raw(static_cast<std::uint32_t>(dice.index(1 << 29)) - (1U << 28));
  if (dice.chance(0.4)) {
    next.at =
        pose.at + polar(next.heading, Length::from_raw(static_cast<std::int32_t>(dice.uniform(-40e3, 40e3))));
  }
  const double free_m = metres(rim_sweep(p).radius) + metres(Length::from_raw(60));
  return world.reaches(vec(next.at), free_m) ? pose : next;
}

}  // namespace

std::string judge_grid(Dice& dice) {
  constexpr double kSlack = 2e-6;
  for (int i = 0; i < 12; ++i) {
    const Params p = draw_eyes(dice);
    const Length cell = grid_cell(p);
    const double rounding = metres(cell) * 0.03 + 1e-5;
    Pose pose = draw_pose(dice);
    Clutter world = draw_clutter(dice, p, pose, metres(rim_sweep(p).radius) + 1e-4);
    LocalGrid grid;
    grid.configure(p);
    grid.reset(pose);
    for (int turn = 0; turn < 6; ++turn) {
      std::vector<ConeObservation> seen;
      for (int beam = 0; beam < 3; ++beam) {
        seen.push_back(look(p, world, pose, beam));
        seen.back().aimed = dice.chance(0.2);
        if (!dice.chance(0.3)) {
          grid.mark(seen.back());
          continue;
        }
        // Clear only what an earlier reading from elsewhere shows empty, too.
        Pose other = pose;
        other.heading += Angle::from_raw(static_cast<std::uint32_t>(dice.index(1 << 28)) - (1U << 27));
        const ConeObservation then = look(p, world, other, beam);
        const perception::EarlierObservation before{then.beam.apex, then.beam.axis, then.free};
        grid.mark(seen.back(), &before);
        seen.pop_back();
      }
      std::string wrong;
      each_cell(pose.at, cell, [&](Vec at) {
        const Square square = Square::around(at, cell);
        const bool clear = grid.is_clear(at);
        if (clear && square.covered(world, kSlack)) wrong = "an obstacle stands on clear ground";
        if (clear || !well_inside(p, pose, at)) return;
        if (is_under(p, pose, at) && square.farthest(vec(pose.at)) < metres(rim_sweep(p).radius) - rounding) {
          wrong = "the ground under the body is not clear";
        }
        for (const ConeObservation& o : seen) {
          if (empty_by(square, o.beam, o.free) > rounding) wrong = "ground seen empty is not clear";
        }
      });
      if (!wrong.empty()) return wrong;
      pose = draw_step(dice, p, world, pose);
      grid.move_to(pose);
    }
  }
  return "";
}

namespace {

/// Random clear and suspect ground around a body at rest.
LocalGrid draw_grid(Dice& dice, const Params& p, const Pose& pose) {
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  for (int i = dice.index(30); i > 0; --i) {
    ConeObservation seen;
    seen.beam = {pose.at, draw_angle(dice), Angle::from_raw(p.rangefinders.cone.raw() / 2)};
    seen.free = millimetres(80 + dice.index(320));
    seen.hit = dice.chance(0.7);
    grid.mark(seen);
  }
  for (int i = dice.index(3); i > 0; --i) {
    grid.block(pose.at + polar(draw_angle(dice), millimetres(95 + dice.index(80))),
               millimetres(dice.index(15)));
  }
  return grid;
}

struct Path {
  Vec2 from, way;  // way: of unit length
  double length;
  double off(const Square& cell, double on) const { return cell.nearest(from + way * on); }
  double off(const Square& cell) const {
    double least = 1e9;
    for (int i = 0; i <= 60; ++i) least = std::min(least, off(cell, length * i / 60));
    return least;
  }
};

std::string judge_way(const LocalGrid& grid, const Params& p, const Pose& pose, Length length,
                      Length radius) {
  constexpr double kRounding = 0.0009;
  const double cell = metres(grid_cell(p)), abeam = 80 * cell / 256;
  const Path path{
      vec(pose.at), {std::cos(radians(pose.heading)), std::sin(radians(pose.heading))}, metres(length)};
  const perception::Obstacles found = grid.along(pose.at, pose.heading, length, radius);
  int surely = 0, perhaps = 0;
  bool nears = false, may_near = false, clear = true, may_be_clear = true;
  double nearest = 1e9;
  const double ahead_of_middle = std::max(abeam, path.length / 2);
  const double body = metres(p.body.radius + guard_slack(p));
  each_cell(pose.at, grid_cell(p), [&](Vec at) {
    const Square square = Square::around(at, grid_cell(p));
    if (grid.is_clear(at)) return;
    const double ahead = sim::dot(vec(at) - path.from, path.way), centre = square.nearest(path.from);
    clear = clear && centre > metres(radius) - kRounding;
    may_be_clear = may_be_clear && centre > metres(radius) + kRounding;
    if (!well_inside(p, pose, at)) return;
    const double by = std::min(metres(radius) - path.off(square), ahead - abeam);
    surely += by > kRounding ? 1 : 0;
    perhaps += by > -kRounding ? 1 : 0;
    if (by > kRounding) nearest = std::min(nearest, length_of(vec(at) - path.from));
    const double end = path.off(square, path.length);
    nears = nears || std::min(metres(radius) - end, ahead - ahead_of_middle) > kRounding;
    may_near = may_near || std::min(metres(radius) - end, ahead - ahead_of_middle) > -kRounding ||
               std::min(body - end, ahead - (path.length / 2 - kCellCover * cell / 256)) > -kRounding;
  });
  const int all = found.unknown + found.suspect;
  if (all < surely || all > perhaps) return "a way has other obstacles";
  if (found.unknown > 0) {
    if (grid.is_clear(pose.at + found.nearest_unknown)) return "the nearest unknown cell is clear";
    if (found.suspect == 0 && length_of(vec(found.nearest_unknown)) > nearest + kRounding)
      return "it is not the nearest";
  }
  const int suspects = grid.suspects_along(pose.at, pose.heading, length, radius, INT32_MAX);
  if (suspects != found.suspect) return "another number of suspect cells";
  if ((grid.suspects_along(pose.at, pose.heading, length, radius, 1) > 0) != (suspects > 0))
    return "no first suspect";
  int counted = 0, solid = 0;
  const auto one = [&](Vec off) { counted += grid.is_clear(pose.at + off) ? 1000 : 1; };
  grid.each_unclear(pose.at, pose.heading, length, radius, one);
  grid.each_unclear(
      pose.at, pose.heading, length, radius, [&](Vec) { ++solid; }, perception::Avoid::suspect);
  if (counted != all || solid != suspects) return "each unclear cell is not counted once";
  if (length < LocalGrid::kShortestStep) return "";
  const bool answer = grid.approaches(pose.at, polar(pose.heading, length), radius);
  if (nears && !answer) return "a way nears unclear ground unnoticed";
  if (!may_near && answer) return "a way that nears nothing is refused";
  const bool all_clear = grid.all_clear(pose.at, radius);
  if (all_clear && !may_be_clear && !clear) return "unclear ground in a disc is called clear";
  if (!all_clear && may_be_clear) return "a clear disc is called unclear";
  return "";
}

}  // namespace

std::string judge_grid_paths(Dice& dice) {
  const Params p;
  for (int i = 0; i < 25; ++i) {
    const Pose pose = draw_pose(dice);
    const LocalGrid grid = draw_grid(dice, p, pose);
    for (int k = 0; k < 3; ++k) {
      const Length length = dice.chance(0.1) ? Length{} : micrometres(dice.index(60000));
      const Pose from{pose.at, draw_angle(dice)};
      // The window leads the heading of the last move.
      if (pose.heading.raw() != from.heading.raw() && !dice.chance(0.7)) continue;
      const std::string wrong =
          judge_way(grid, p, {pose.at, pose.heading}, length, millimetres(50 + dice.index(60)));
      if (!wrong.empty()) return wrong;
    }
  }
  return "";
}

namespace {

/// What drops out of the window is forgotten, the rest is kept, and nothing wraps around.
std::string judge_window(Dice& dice) {
  Params p;
  p.boundary.age_travel = 1000_m;
  p.boundary.age_turn = 359_deg;
  LocalGrid grid;
  grid.configure(p);
  Pose pose = draw_pose(dice);
  pose.heading = Angle::turns(dice.index(8), 8);
  grid.reset(pose);
  const double cell = metres(grid_cell(p)), radius = metres(rim_sweep(p).radius);
  using Cells = std::set<std::pair<std::int32_t, std::int32_t>>;
  const auto all = [&] {
    Cells cells;
    each_cell(pose.at, grid_cell(p), [&](Vec at) {
      if (grid.is_clear(at)) cells.insert({at.x.raw(), at.y.raw()});
    });
    return cells;
  };
  Cells before = all();
  for (int step = 0; step < 12; ++step) {
    const int reach = dice.chance(0.1) ? 1500 : 60;
    pose.at = pose.at + Vec{millimetres(dice.index(2 * reach + 1) - reach),
                            millimetres(dice.index(2 * reach + 1) - reach)};
    grid.move_to(pose);
    const Cells now = all();
    for (const auto& [x, y] : now) {
      const Square square = Square::around({Length::from_raw(x), Length::from_raw(y)}, grid_cell(p));
      if (before.count({x, y}) == 0 && square.farthest(vec(pose.at)) > radius + 1e-4)
        return "clear ground from nowhere";
    }
    for (const auto& [x, y] : before) {
      const bool inside = well_inside(p, pose, {Length::from_raw(x), Length::from_raw(y)});
      if (inside && now.count({x, y}) == 0) return "clear ground is lost";
    }
    ConeObservation seen;
    seen.beam = {pose.at, draw_angle(dice), Angle::from_raw(p.rangefinders.cone.raw() / 2)};
    seen.free = 2_m;
    grid.mark(seen);
    before = all();
  }
  static_cast<void>(cell);
  return "";
}

/// Clear ground lives for one to two spans of travel or turning.
std::string judge_age(Dice& dice) {
  Params p;
  p.boundary.age_travel = millimetres(300 + dice.index(1500));
  p.boundary.age_turn = Angle::turns(60 + dice.index(250), 360);
  if (check(p) != ParamFault::none) return "";
  LocalGrid grid;
  grid.configure(p);
  Pose pose{{}, Angle{}};
  grid.reset(pose);
  ConeObservation seen;
  seen.beam = {pose.at, Angle{}, Angle::from_raw(p.rangefinders.cone.raw() / 2)};
  seen.free = 2_m;
  grid.mark(seen);
  const Vec there{250_mm, 0_mm};
  if (!grid.is_clear(there)) return "ground seen empty is not clear";
  const bool turns = dice.chance(0.5);
  const double span = turns ? p.boundary.age_turn.raw() / 4294967296.0 : metres(p.boundary.age_travel);
  double spent = 0;
  for (bool even = false; spent < 2.2 * span; even = !even) {
    if (turns) {
      pose.heading = even ? Angle{} : 5_deg;
      spent += 5.0 / 360;
    } else {
      pose.at.y = even ? 0_mm : 10_mm;
      spent += 0.01;
    }
    grid.move_to(pose);
    const bool clear = grid.is_clear(there);
    if (!clear && spent < 0.98 * span) return "clear ground expires too soon";
    if (clear && spent > 2.05 * span) return "clear ground never expires";
  }
  return "";
}

/// An echo takes back the arc that it comes from, where all of that is clear, and nothing else.
std::string judge_revocation(Dice& dice) {
  const Params p;
  const double cell = metres(grid_cell(p));
  const Pose pose = draw_pose(dice);
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  grid.move_to(pose);
  const auto beam = [&](Angle off) {
    return perception::Beam{pose.at, pose.heading + off, Angle::from_raw(p.rangefinders.cone.raw() / 2)};
  };
  for (int deg = -44; deg <= 44; deg += 2) {
    ConeObservation seen;
    seen.beam = beam(Angle::turns(deg, 360));
    seen.free = 2_m;
    grid.mark(seen);
  }
  const LocalGrid before = grid;
  const perception::Beam echo = beam(Angle::turns(dice.index(41) - 20, 360));
  const Length nearest = millimetres(130 + dice.index(90)), farthest = nearest + millimetres(dice.index(40));
  const bool takes = dice.chance(0.5);
  if (takes) grid.take_back(echo, nearest, farthest);
  if (!takes) grid.revoke(echo, nearest, farthest);
  std::string wrong;
  each_cell(pose.at, grid_cell(p), [&](Vec at) {
    if (!before.is_clear(at)) return;
    const Vec2 off = vec(at) - vec(echo.apex);
    const double far = length_of(off);
    const double angle =
        std::fabs(std::remainder(std::atan2(off.y, off.x) - radians(echo.axis), 2 * sim::kPi));
    const double half = radians(echo.half_cone);
    const bool in = far > metres(nearest) && far < metres(farthest) + cell * 0.9 && angle < half - 0.01;
    const bool out =
        far < metres(nearest) - cell || far > metres(farthest) + 2 * cell || (angle - half) * far > cell;
    if (in && grid.is_clear(at)) wrong = "an echo leaves its ground clear";
    if (out && !grid.is_clear(at)) wrong = "an echo takes other ground back";
  });
  return wrong;
}

/// Someone says that nothing stands within a distance.
std::string judge_vouched(Dice& dice) {
  const Params p;
  const Pose pose = draw_pose(dice);
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  perception::Beam beams[3];
  Length free[3];
  for (int i = 0; i < 3; ++i) {
    beams[i] = perception::beam_of(mount(p.rangefinders, i), pose);
    free[i] = millimetres(150 + dice.index(300));
  }
  const Length radius = millimetres(100 + dice.index(120));
  grid.vouch(pose.at, radius, beams, free);
  std::string wrong;
  each_cell(pose.at, grid_cell(p), [&](Vec at) {
    const Square square = Square::around(at, grid_cell(p));
    const bool clear = grid.is_clear(at);
    const double by = metres(radius) - square.farthest(vec(pose.at));
    if (clear && by < -1e-4 && !is_under(p, pose, at)) wrong = "ground beyond the vouched is clear";
    bool covered = false, beside = true;
    for (int i = 0; i < 3; ++i) {
      covered = covered || empty_by(square, beams[i], 100_m) > metres(grid_cell(p)) * 0.05;
      beside = beside && empty_by(square, beams[i], 100_m) < -2.2 * metres(grid_cell(p));
    }
    if (clear && covered && !is_under(p, pose, at)) wrong = "ground in a beam is vouched for";
    if (!clear && beside && by > metres(grid_cell(p)) * 0.1) wrong = "vouched ground is not clear";
  });
  return wrong;
}

/// Cells that a disc touches are suspect afterwards, except under the body.
std::string judge_block(Dice& dice) {
  const Params p;
  const Pose pose = draw_pose(dice);
  LocalGrid grid = draw_grid(dice, p, pose);
  const LocalGrid before = grid;
  const Vec at = pose.at + polar(draw_angle(dice), millimetres(60 + dice.index(150)));
  const Length radius = millimetres(1 + dice.index(40));
  grid.block(at, radius);
  std::string wrong;
  each_cell(pose.at, grid_cell(p), [&](Vec centre) {
    const double by = metres(radius) - Square::around(centre, grid_cell(p)).nearest(vec(at));
    const bool under =
        Square::around(centre, grid_cell(p)).farthest(vec(pose.at)) < metres(rim_sweep(p).radius) + 0.001;
    if (by > 0.0005 && !under && grid.is_clear(centre)) wrong = "touched ground is clear";
    const bool surely_under =
        Square::around(centre, grid_cell(p)).farthest(vec(pose.at)) < metres(rim_sweep(p).radius) - 0.001;
    if ((by < -0.001 || surely_under) && before.is_clear(centre) && !grid.is_clear(centre)) {
      wrong = "ground beside a touch is taken back";
    }
  });
  return wrong;
}

}  // namespace

std::string judge_grid_times(Dice& dice) {
  for (int i = 0; i < 6; ++i) {
    for (const JudgePart judge : {judge_window, judge_age, judge_revocation, judge_vouched, judge_block}) {
      std::string wrong = judge(dice);
      if (!wrong.empty()) return wrong;
    }
  }
  return "";
}

}  // namespace whisker::hunt

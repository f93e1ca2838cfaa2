// What the local grid calls clear, against the obstacles and the beams that made it so.
#include <algorithm>
#include <cmath>

#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/grid_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

/// A turn, or a way that covers nothing.
Pose draw_step(Dice& dice, const Params& p, const Clutter& world, const Pose& pose) {
  Pose next = pose;
  next.heading += Angle::from_raw(static_cast<std::uint32_t>(dice.index(1 << 29)) - (1U << 28));
  if (dice.chance(0.4)) {
    next.at = pose.at + polar(next.heading, Length::from_raw(static_cast<std::int32_t>(
                                                dice.uniform(-0.44, 0.44) * p.body.radius.raw())));
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
  // The direction of a short way is rounded.
  const double sharp = length < 5_mm ? 0.004 : kRounding;
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
    nears = nears || std::min(metres(radius) - end, ahead - ahead_of_middle) > sharp;
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
  int counted = 0;
  const auto one = [&](Vec off) { counted += grid.is_clear(pose.at + off) ? 1000 : 1; };
  grid.each_unclear(pose.at, pose.heading, length, radius, one);
  if (counted != all) return "each unclear cell is not counted once";
  const Vec way = polar(pose.heading, length);
  if (norm(way) < LocalGrid::kShortestStep) return "";
  const bool answer = grid.approaches(pose.at, way, radius);
  if (nears && !answer) return "a way nears unclear ground unnoticed";
  if (!may_near && answer) return "a way that nears nothing is refused";
  const bool all_clear = grid.all_clear(pose.at, radius);
  if (all_clear && !may_be_clear && !clear) return "unclear ground in a disc is called clear";
  if (!all_clear && may_be_clear) return "a clear disc is called unclear";
  return "";
}

}  // namespace

namespace {

/// Beyond the window nothing is clear.
std::string judge_disc(Dice& dice, const LocalGrid& grid, const Params& p, const Pose& pose) {
  const Vec at = pose.at + polar(draw_angle(dice), millimetres(dice.index(420)));
  const Length radius = millimetres(10 + dice.index(60));
  bool clear = true, may_be = true;
  each_cell(at, grid_cell(p), [&](Vec centre) {
    if (grid.is_clear(centre)) return;
    const double far = Square::around(centre, grid_cell(p)).nearest(vec(at));
    clear = clear && far > metres(radius) + 0.0009;
    may_be = may_be && far > metres(radius) - 0.0009;
  });
  const bool answer = grid.all_clear(at, radius);
  if (answer && !may_be) return "a disc on unclear ground is called clear";
  const bool near = length_of(vec(at) - vec(pose.at)) < 0.15;
  return near && !answer && clear ? "a disc on clear ground is called unclear" : "";
}

}  // namespace

std::string judge_grid_paths(Dice& dice) {
  const Params p;
  for (int i = 0; i < 25; ++i) {
    const Pose pose = draw_pose(dice);
    const LocalGrid grid = draw_grid(dice, p, pose);
    for (int k = 0; k < 4; ++k) {
      const std::string other = judge_disc(dice, grid, p, pose);
      if (!other.empty()) return other;
    }
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

}  // namespace whisker::hunt

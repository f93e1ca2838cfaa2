/// Which cells of a local grid a beam shows empty, which lie under the body, and random grids.
#pragma once

#include <algorithm>
#include <cmath>

#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"

namespace whisker::hunt {

using perception::ConeObservation;
using perception::LocalGrid;
using sim::Vec2;

/// How far all corners of the cell lie inside the empty sector.
inline double empty_by(const Square& cell, const perception::Beam& beam, Length free) {
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
inline bool well_inside(const Params& p, const Pose& pose, Vec at) {
  const double cell = metres(grid_cell(p));
  const Vec2 ahead{std::cos(radians(pose.heading)), std::sin(radians(pose.heading))};
  const Vec2 off = vec(at) - (vec(pose.at) + ahead * (3 * cell));
  return std::max(std::fabs(off.x), std::fabs(off.y)) < 14 * cell;
}

inline bool is_under(const Params& p, const Pose& pose, Vec at) {
  return Square::around(at, grid_cell(p)).farthest(vec(pose.at)) <= metres(rim_sweep(p).radius);
}

/// Random clear and suspect ground around a body at rest.
inline LocalGrid draw_grid(Dice& dice, const Params& p, const Pose& pose) {
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

}  // namespace whisker::hunt

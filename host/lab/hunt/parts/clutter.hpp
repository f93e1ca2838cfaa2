/// Random obstacles, true readings among them, and what they cover.
#pragma once

#include <cmath>
#include <vector>

#include "firmware/perception/local_grid.hpp"
#include "host/harness/sim/world.hpp"
#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

constexpr double metres(Length l) { return l.raw() * 1e-6; }
inline sim::Vec2 vec(Vec v) { return {metres(v.x), metres(v.y)}; }
inline double length_of(sim::Vec2 v) { return std::hypot(v.x, v.y); }

struct Clutter {
  std::vector<sim::Disc> discs;
  std::vector<sim::Segment> segments;
  sim::WorldView view() const;
  /// Of the nearest obstacle; 1e9 without one.
  double distance(sim::Vec2 at) const;
  bool reaches(sim::Vec2 at, double distance_m) const { return distance(at) <= distance_m; }
};

/// Up to six obstacles around the body, none within `free_m` of it.
Clutter draw_clutter(Dice& dice, const Params& p, const Pose& pose, double free_m);

/// The nearest distance in the cone of this beam, at most the maximum range.
double range_m(const Params& p, const Clutter& world, const sim::Pose& pose, int beam);
/// What this beam measures, rounded to a millimetre.
perception::ConeObservation look(const Params& p, const Clutter& world, const Pose& pose, int beam);

/// On an axis of the grid, next to one, or anywhere.
Angle draw_angle(Dice& dice);
Pose draw_pose(Dice& dice);
/// A robot whose cells, cones and mounts vary, and that check() accepts.
Params draw_eyes(Dice& dice);

/// A closed square.
struct Square {
  sim::Vec2 low, high;
  /// Of the cell that has this point in it.
  static Square around(Vec at, Length cell);
  sim::Vec2 middle() const { return (low + high) * 0.5; }
  double nearest(sim::Vec2 p) const;
  double farthest(sim::Vec2 p) const;
  /// An obstacle covers a part of it, by more than `slack_m`.
  bool covered(const Clutter& world, double slack_m) const;
};

/// Calls f with the centre of each cell around this place.
template <class F>
void each_cell(Vec at, Length cell, const F& f) {
  const auto first = [&](Length x) {
    return (x.raw() >= 0 ? x.raw() : x.raw() - cell.raw() + 1) / cell.raw() - 22;
  };
  const auto centre = [&](std::int32_t n) { return Length::from_raw(n * cell.raw() + cell.raw() / 2); };
  const std::int32_t left = first(at.x), bottom = first(at.y);
  for (std::int32_t row = bottom; row <= bottom + 44; ++row) {
    for (std::int32_t column = left; column <= left + 44; ++column) f(Vec{centre(column), centre(row)});
  }
}

}  // namespace whisker::hunt

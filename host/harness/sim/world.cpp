#include "host/harness/sim/world.hpp"

#include "host/harness/sim/distance.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {
namespace {

double length(Vec2 v) { return square_root(dot(v, v)); }

// Takes the square root only if the disc may be nearer than the best so far.
double nearer(double best, Vec2 p, Vec2 center, double radius) {
  const Vec2 q = p - center;
  const double reach = best + radius;
  const double d2 = dot(q, q);
  return reach > 0 && d2 < reach * reach ? square_root(d2) - radius : best;
}

}  // namespace

Vec2 position(const MovingDisc& mover, double t) {
  double total = 0;
  for (size_t i = 1; i < mover.count; ++i) total += length(mover.points[i] - mover.points[i - 1]);
  if (!(total > 0)) return mover.points[0];

  double arc = mover.start_arc + mover.speed * t;
  arc -= 2 * total * static_cast<double>(whole_below(arc / (2 * total)));
  if (arc > total) arc = 2 * total - arc;
  for (size_t i = 1; i < mover.count; ++i) {
    const Vec2 leg = mover.points[i] - mover.points[i - 1];
    const double leg_length = length(leg);
    if (arc < leg_length) return mover.points[i - 1] + leg * (arc / leg_length);
    arc -= leg_length;
  }
  return mover.points[mover.count - 1];
}

double fastest_mover(const WorldView& world) {
  double fastest = 0;
  for (size_t i = 0; i < world.mover_count; ++i) {
    if (world.movers[i].speed > fastest) fastest = world.movers[i].speed;
  }
  return fastest;
}

double clearance(const WorldView& world, Vec2 p, double t, double body_radius) {
  double best = __builtin_huge_val();
  for (size_t i = 0; i < world.disc_count; ++i) {
    best = nearer(best, p, world.discs[i].center, world.discs[i].radius);
  }
  for (size_t i = 0; i < world.mover_count; ++i) {
    best = nearer(best, p, position(world.movers[i], t), world.movers[i].radius);
  }
  if (best > 0) {
    double best2 = best * best;
    for (size_t i = 0; i < world.segment_count; ++i) {
      const double d2 = squared_distance(p, world.segments[i]);
      if (d2 < best2) best2 = d2;
    }
    if (best2 < best * best) best = square_root(best2);
  }
  return best - body_radius;
}

}  // namespace whisker::sim

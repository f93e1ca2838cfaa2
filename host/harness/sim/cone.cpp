#include "host/harness/sim/cone.hpp"

#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {
namespace {

constexpr double kNothing = __builtin_huge_val();

// Seen from the apex, the distance to a disc's rim grows with the angle from the centre's direction. So the
// nearest point lies in that direction or, if the cone misses it, on the nearer edge.
double nearer(double best, const Cone& cone, Vec2 center, double radius) {
  const Vec2 q = center - cone.apex;
  const double d2 = dot(q, q);
  const double reach = best + radius;
  if (d2 >= reach * reach) return best;
  if (d2 <= radius * radius) return 0;
  const double ahead = dot(q, cone.axis);
  const double turned = cross(cone.axis, q);
  const double aside = turned < 0 ? -turned : turned;
  const double outside = aside * cone.cos_half - ahead * cone.sin_half;
  if (outside > radius + kConeSlack) return best;
  double d;
  if (outside <= 0) {
    d = square_root(d2) - radius;
  } else {
    const double along = ahead * cone.cos_half + aside * cone.sin_half;
    if (along <= 0) return best;
    // The ray along the edge passes the centre at this distance: over the radius, the sine of its incidence.
    if (cone.sin_incidence < 1 && outside > radius * cone.sin_incidence) return best;
    const double half_chord2 = radius * radius - outside * outside;
    d = along - (half_chord2 > 0 ? square_root(half_chord2) : 0.0);
  }
  return d < best ? d : best;
}

struct Interval {
  double low;
  double high;
};

// Keeps the part of the interval where start + (end - start) t >= 0.
bool cut(Interval& kept, double start, double end) {
  if (start < 0 && end < 0) return false;
  if (start < 0) {
    const double t = start / (start - end);
    if (t > kept.low) kept.low = t;
  } else if (end < 0) {
    const double t = start / (start - end);
    if (t < kept.high) kept.high = t;
  }
  return kept.low <= kept.high;
}

double nearer(double best, const Cone& cone, Vec2 end) {
  const double d2 = dot(end, end);
  return d2 <= cone.scatter * cone.scatter && d2 < best * best ? square_root(d2) : best;
}

// A half width below 90 degrees makes the cone the intersection of two half planes.
double nearer(double best, const Cone& cone, const Segment& s) {
  const Vec2 qa = s.a - cone.apex;
  const Vec2 qb = s.b - cone.apex;
  const Vec2 a{dot(qa, cone.axis), cross(cone.axis, qa)};
  const Vec2 b{dot(qb, cone.axis), cross(cone.axis, qb)};
  if (a.x > best && b.x > best) return best;
  const double sa = a.x * cone.sin_half + kConeSlack;
  const double sb = b.x * cone.sin_half + kConeSlack;
  Interval kept{0, 1};
  if (!cut(kept, sa - a.y * cone.cos_half, sb - b.y * cone.cos_half)) return best;
  if (!cut(kept, sa + a.y * cone.cos_half, sb + b.y * cone.cos_half)) return best;
  const Vec2 d = b - a;
  const double length2 = dot(d, d);
  double t = length2 > 0 ? -dot(a, d) / length2 : 0.0;
  if (t < kept.low) t = kept.low;
  if (t > kept.high) t = kept.high;
  const Vec2 nearest = a + d * t;
  const double d2 = dot(nearest, nearest);
  // Of the points in the cone, the nearest one has the smallest incidence.
  const double along = dot(nearest, d);
  if (cone.sin_incidence < 1 && along * along > cone.sin_incidence * cone.sin_incidence * d2 * length2) {
    if (kept.low <= 0) best = nearer(best, cone, a);
    return kept.high >= 1 ? nearer(best, cone, b) : best;
  }
  return d2 < best * best ? square_root(d2) : best;
}

}  // namespace

double range(const Cone& cone, const Disc& disc) { return nearer(kNothing, cone, disc.center, disc.radius); }

double range(const Cone& cone, const Segment& segment) { return nearer(kNothing, cone, segment); }

double range(const Cone& cone, const WorldView& world, double t, double limit, double soft_limit) {
  double best = limit;
  const uint8_t* soft = world.soft;
  const auto add = [&](auto... obstacle) {
    const bool absorbs = soft != nullptr && *soft++ != 0;
    const double within = absorbs && soft_limit < best ? soft_limit : best;
    const double d = nearer(within, cone, obstacle...);
    if (d < within) best = d;
  };
  for (size_t i = 0; i < world.disc_count; ++i) add(world.discs[i].center, world.discs[i].radius);
  for (size_t i = 0; i < world.mover_count; ++i) add(position(world.movers[i], t), world.movers[i].radius);
  for (size_t i = 0; i < world.segment_count; ++i) add(world.segments[i]);
  return best < limit ? best : kNothing;
}

}  // namespace whisker::sim

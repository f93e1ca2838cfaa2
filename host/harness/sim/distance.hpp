/// Exact distances in the plane.
#pragma once

#include <stddef.h>

#include "host/harness/sim/geometry.hpp"

namespace whisker::sim {

/// From a point to the rim of the disc, m; negative inside.
double signed_distance(Vec2 p, const Disc& disc);

/// From a point to the nearest point of a closed segment, m; a segment may be a single point.
double distance(Vec2 p, const Segment& segment);

/// The square of distance(p, segment).
inline double squared_distance(Vec2 p, const Segment& s) {
  const Vec2 along = s.b - s.a;
  const Vec2 from_a = p - s.a;
  const double t = dot(from_a, along);
  if (t <= 0) return dot(from_a, from_a);
  const double length2 = dot(along, along);
  if (t >= length2) return dot(p - s.b, p - s.b);
  const double c = cross(along, from_a);
  return c * c / length2;
}

/// Whether the point lies inside the closed polygon, by the even-odd rule; the last point joins the first.
/// The result for a point on an edge is undefined: use distance() there.
bool contains(const Vec2* points, size_t count, Vec2 p);

}  // namespace whisker::sim

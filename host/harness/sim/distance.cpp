#include "host/harness/sim/distance.hpp"

#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {

double signed_distance(Vec2 p, const Disc& disc) {
  const Vec2 q = p - disc.center;
  return square_root(dot(q, q)) - disc.radius;
}

double distance(Vec2 p, const Segment& segment) { return square_root(squared_distance(p, segment)); }

bool contains(const Vec2* points, size_t count, Vec2 p) {
  bool inside = false;
  for (size_t i = 0; i < count; ++i) {
    const Vec2 a = points[i];
    const Vec2 b = points[i + 1 < count ? i + 1 : 0];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    const double side = cross(b - a, p - a);
    if ((side > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

}  // namespace whisker::sim

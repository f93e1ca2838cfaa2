#include "host/harness/scenario/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace whisker {
namespace {

using sim::Segment;
using sim::Vec2;

int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double area = cross(b - a, c - a);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

bool in_box(Vec2 p, const Segment& s) {
  return std::min(s.a.x, s.b.x) <= p.x && p.x <= std::max(s.a.x, s.b.x) && std::min(s.a.y, s.b.y) <= p.y &&
         p.y <= std::max(s.a.y, s.b.y);
}

bool pass(const Segment& a, const Segment& b) {
  return orientation(b.a, b.b, a.a) * orientation(b.a, b.b, a.b) < 0 &&
         orientation(a.a, a.b, b.a) * orientation(a.a, a.b, b.b) < 0;
}

bool folds_back(const Segment& first, const Segment& second) {
  const Vec2 u = first.b - first.a;
  const Vec2 v = second.b - second.a;
  return cross(u, v) == 0 && dot(u, v) < 0;
}

}  // namespace

double distance(Vec2 a, Vec2 b) { return std::sqrt(dot(b - a, b - a)); }

double distance(Vec2 p, const Segment& s) {
  const Vec2 along = s.b - s.a;
  const double length_squared = dot(along, along);
  if (length_squared == 0) return distance(p, s.a);
  const double t = std::clamp(dot(p - s.a, along) / length_squared, 0.0, 1.0);
  return distance(p, s.a + along * t);
}

double distance(Vec2 p, const std::vector<Vec2>& polyline) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
    nearest = std::min(nearest, distance(p, Segment{polyline[i], polyline[i + 1]}));
  }
  return nearest;
}

bool intersect(const Segment& a, const Segment& b) {
  const int a1 = orientation(b.a, b.b, a.a);
  const int a2 = orientation(b.a, b.b, a.b);
  const int b1 = orientation(a.a, a.b, b.a);
  const int b2 = orientation(a.a, a.b, b.b);
  if (a1 * a2 < 0 && b1 * b2 < 0) return true;
  return (a1 == 0 && in_box(a.a, b)) || (a2 == 0 && in_box(a.b, b)) || (b1 == 0 && in_box(b.a, a)) ||
         (b2 == 0 && in_box(b.b, a));
}

Segment edge(const std::vector<Vec2>& polygon, std::size_t i) {
  return {polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1]};
}

double signed_area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Segment e = edge(polygon, i);
    twice += cross(e.a - polygon[0], e.b - polygon[0]);
  }
  return twice / 2;
}

bool inside(Vec2 p, const std::vector<Vec2>& polygon) {
  bool odd = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto [a, b] = edge(polygon, i);
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y))) odd = !odd;
  }
  return odd;
}

using EdgePair = std::optional<std::pair<std::size_t, std::size_t>>;

namespace {

/// The first two non-adjacent edges that satisfy the condition.
EdgePair two_edges(const std::vector<Vec2>& polygon, bool (*are)(const Segment&, const Segment&)) {
  const std::size_t n = polygon.size();
  // Compares only edges whose spans along x overlap, so that long outlines stay fast.
  const auto low = [&](std::size_t i) { return std::min(edge(polygon, i).a.x, edge(polygon, i).b.x); };
  const auto high = [&](std::size_t i) { return std::max(edge(polygon, i).a.x, edge(polygon, i).b.x); };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t m = k + 1; m < n && low(order[m]) <= high(order[k]); ++m) {
      const auto [i, j] = std::minmax(order[k], order[m]);
      const bool neighbours = j - i == 1 || j - i == n - 1;
      if (!neighbours && are(edge(polygon, i), edge(polygon, j))) return std::pair{i, j};
    }
  }
  return std::nullopt;
}

}  // namespace

EdgePair passing_edges(const std::vector<Vec2>& polygon) { return two_edges(polygon, pass); }

EdgePair crossing_edges(const std::vector<Vec2>& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = i + 1 == n ? 0 : i + 1;
    if (folds_back(edge(polygon, i), edge(polygon, next))) return std::minmax(i, next);
  }
  return two_edges(polygon, intersect);
}

}  // namespace whisker

#include "host/lab/paths/tangent.hpp"

#include <cmath>

namespace whisker::paths {
namespace {

using sim::Vec2;

constexpr double kSlack = 1e-9;  // a point this deep inside a disc counts as on its rim

double signed_radius(const sim::Disc& disc, Side side) { return disc.radius * static_cast<int>(side); }

}  // namespace

Vec2 touch(const sim::Disc& disc, Side side, Vec2 normal) {
  return disc.center - normal * signed_radius(disc, side);
}

std::optional<Tangent> tangent(const sim::Disc& a, Side side_a, const sim::Disc& b, Side side_b) {
  const Vec2 between = b.center - a.center;
  const double d2 = sim::dot(between, between);
  const double d = std::sqrt(d2);
  // The normal points from the line to the centre of a disc on its left, with the radius as length.
  const double across = signed_radius(b, side_b) - signed_radius(a, side_a);
  if (d <= 0 || std::fabs(across) > d + kSlack) return std::nullopt;
  const double length = std::sqrt(std::fmax(0, d2 - across * across));
  const Vec2 e = between * (1 / d);
  const Vec2 f{-e.y, e.x};
  const Vec2 normal = e * (across / d) + f * (length / d);
  return Tangent{{touch(a, side_a, normal), touch(b, side_b, normal)}, length, normal};
}

}  // namespace whisker::paths

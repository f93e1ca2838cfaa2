#include "host/scenario/bearing.hpp"

#include <cmath>

namespace whisker {
namespace {

constexpr double kPi = 3.141592653589793;

/// t in [0, 1]. Two halvings bring the angle below pi / 16, where 14 terms of the series suffice.
double arctangent(double t) {
  for (int i = 0; i < 2; ++i) t = t / (1 + std::sqrt(1 + t * t));
  const double square = t * t;
  double sum = 0;
  for (int k = 27; k >= 1; k -= 2) sum = 1.0 / k - square * sum;
  return 4 * (t * sum);
}

}  // namespace

double bearing(sim::Vec2 from, sim::Vec2 to) {
  const sim::Vec2 d = to - from;
  const double x = std::fabs(d.x);
  const double y = std::fabs(d.y);
  if (x == 0 && y == 0) return 0;
  const double acute = y <= x ? arctangent(y / x) : kPi / 2 - arctangent(x / y);
  const double upper = d.x < 0 ? kPi - acute : acute;
  return d.y < 0 ? -upper : upper;
}

}  // namespace whisker

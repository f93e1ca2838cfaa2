#include "host/worlds/direction.hpp"

#include "host/scenario/bearing.hpp"

namespace whisker::worlds {
namespace {

/// The sums of the series of sine and cosine; |x| <= pi / 4.
sim::Vec2 eighth(double x) {
  const double square = x * x;
  double sine = 1;
  double cosine = 1;
  for (int k = 20; k >= 2; k -= 2) {
    sine = 1 - sine * square / (k * (k + 1));
    cosine = 1 - cosine * square / (k * (k - 1));
  }
  return {cosine, sine * x};
}

}  // namespace

sim::Vec2 direction(double degrees) {
  while (degrees >= 360) degrees -= 360;
  while (degrees < 0) degrees += 360;
  int quarters = 0;
  for (; degrees > 45; degrees -= 90) ++quarters;
  sim::Vec2 v = eighth(degrees * kRadPerDeg);
  for (; quarters > 0; --quarters) v = {-v.y, v.x};
  return v;
}

}  // namespace whisker::worlds

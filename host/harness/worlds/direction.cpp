#include "host/harness/worlds/direction.hpp"

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::worlds {
sim::Vec2 direction(double degrees) {
  while (degrees >= 360) degrees -= 360;
  while (degrees < 0) degrees += 360;
  int quarters = 0;
  for (; degrees > 45; degrees -= 90) ++quarters;
  const sim::SinCos first = sim::sin_cos(degrees * kRadPerDeg);
  sim::Vec2 v{first.cos, first.sin};
  for (; quarters > 0; --quarters) v = {-v.y, v.x};
  return v;
}

}  // namespace whisker::worlds

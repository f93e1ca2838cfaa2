#include "host/harness/sim/motion.hpp"

#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {
namespace {

double smaller(double a, double b) { return a < b ? a : b; }

// sin(x) / x
double chord_over_arc(double x) {
  if (x > 0.25 || x < -0.25) return sin_cos(x).sin / x;
  const double z = x * x;
  return 1 + z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880))));
}

}  // namespace

Pose along(const Arc& arc, double fraction) {
  const double half_turn = 0.5 * arc.turn * fraction;
  const double chord = arc.length * fraction * chord_over_arc(half_turn);
  const SinCos mean = sin_cos(arc.from.heading + half_turn);
  return {arc.from.at + Vec2{mean.cos, mean.sin} * chord, arc.from.heading + arc.turn * fraction};
}

Sweep sweep(const WorldView& world, const Arc& arc, double t, double duration, double body_radius,
            double clearance_before, double least_before) {
  const double path = arc.length < 0 ? -arc.length : arc.length;
  const double reach = path + fastest_mover(world) * duration;

  Sweep free{0, false, clearance_before, least_before};
  double stride = 1;
  while (free.fraction < 1) {
    const double next = smaller(1, free.fraction + stride);
    const double gap = clearance(world, along(arc, next).at, t + duration * next, body_radius);
    const double span = reach * (next - free.fraction);
    const double bound = 0.5 * (free.clearance + gap - span);
    const double least = smaller(free.least_clearance, gap);
    if (bound > 0 && gap > kContactGap && bound >= least - kClearanceSlack) {
      free = {next, false, gap, least};
      stride *= 2;
    } else if (span <= kContactGap) {
      free.contact = true;
      return free;
    } else {
      stride = 0.5 * (next - free.fraction);
    }
  }
  return free;
}

}  // namespace whisker::sim

#include "host/harness/sim/tapered_cone.hpp"

namespace whisker::sim {
namespace {

Cone with_half_width(Cone cone, double half_width) {
  const SinCos half = sin_cos(half_width);
  cone.cos_half = half.cos;
  cone.sin_half = half.sin;
  return cone;
}

}  // namespace

TaperedCone::TaperedCone(const Cone& cone, double half_width, double far_half_width, double full_reach)
    : widest(with_half_width(cone, half_width)), near(half_width), far(far_half_width), reach(full_reach) {}

// Let g(w) be the range in a plain cone of half width w; it does not fall as w falls. No point nearer than d
// is in view, so all that is in view lies in the plain cone of half_width(d), and is at least
// g(half_width(d)) away: that is the next d. The sequence rises to the range. Where it stops, its point lies
// in the plain cone of the distance before, which is at most kTaperSlack * reach less.
double range(const TaperedCone& cone, const WorldView& world, double t, double limit, double soft_limit) {
  double before = 0;
  double d = range(cone.widest, world, t, limit, soft_limit);
  while (d < limit && before < cone.reach && d - before > kTaperSlack * cone.reach) {
    before = d;
    d = range(with_half_width(cone.widest, cone.half_width(d)), world, t, limit, soft_limit);
  }
  return d;
}

}  // namespace whisker::sim

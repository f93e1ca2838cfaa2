#include "host/harness/sim/bumper.hpp"

#include "hal/types.hpp"
#include "host/harness/sim/distance.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {
namespace {

constexpr double kFrontTangent = 0.57735026918962576;  // of 30 degrees

/// The point of the segment nearest to p.
Vec2 foot(Vec2 p, const Segment& s) {
  const Vec2 along = s.b - s.a;
  const double t = dot(p - s.a, along);
  if (t <= 0) return s.a;
  const double length2 = dot(along, along);
  return t >= length2 ? s.b : s.a + along * (t / length2);
}

}  // namespace

uint8_t switch_pressed(const WorldView& world, const Pose& body, double body_radius, double reach) {
  double nearest = body_radius + reach;
  Vec2 to{};  // towards the nearest point
  for (size_t i = 0; i < world.disc_count; ++i) {
    const double away = signed_distance(body.at, world.discs[i]);
    if (away > nearest) continue;
    nearest = away;
    to = world.discs[i].center - body.at;
  }
  for (size_t i = 0; i < world.segment_count; ++i) {
    const double away = distance(body.at, world.segments[i]);
    if (away > nearest) continue;
    nearest = away;
    to = foot(body.at, world.segments[i]) - body.at;
  }
  const SinCos heading = sin_cos(body.heading);
  const double ahead = dot(to, {heading.cos, heading.sin});
  const double aside = cross({heading.cos, heading.sin}, to);
  if (ahead <= 0) return 0;
  if (aside * aside <= ahead * ahead * kFrontTangent * kFrontTangent) return 1U << hal::kFront;
  return aside > 0 ? 1U << hal::kLeft : 1U << hal::kRight;
}

}  // namespace whisker::sim

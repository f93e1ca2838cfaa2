#include "tests/perception/chain_worlds.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/run/spec.hpp"

namespace whisker::test {
namespace {

using perception::Beam;
using sim::Vec2;
using worlds::Random;

constexpr double kTurn = 2 * 3.14159265358979323846;
constexpr double kPole = 0.0005;  // m, radius
constexpr double kTouch = 1e-7;   // m, from the body to an obstacle that all but touches it

Vec2 towards(double angle) { return {std::cos(angle), std::sin(angle)}; }

Params draw_any_robot(Random& random) {
  Params p;
  p.body.radius = millimetres(20 + random.index(130));
  p.body.margin = millimetres(random.index(30));
  p.body.track = p.body.radius * 3 / 2;
  if (random.chance(0.5)) p.wheels.counts_per_metre = 1000000;
  RangefinderParams& r = p.rangefinders;
  const auto cone = [&] { return tenths(20 + random.index(random.chance(0.1) ? 580 : 380)); };
  const auto beside = [&](double low, double high) {
    return Length::from_raw(static_cast<int32_t>(p.body.radius.raw() * random.uniform(low, high)));
  };
  r.max_range = millimetres(500 + random.index(1500));
  r.cone = cone();
  r.side_angle = tenths(50 + random.index(800));
  if (random.chance(0.5)) r.offset = beside(0, 1.3);
  if (random.chance(0.5)) return p;
  for (int i = 0; i < 3; ++i) {
    BeamParams& own = r.beams[i];
    own.x = beside(-0.5, 1.1);
    own.y = beside(-0.8, 0.8);
    own.cone = cone();
    own.angle = direction_of(tenths(600 * (1 - i) + random.index(500) - 250));
  }
  return p;
}

/// The drive during this turn that moves the axis only this far at this distance from the apex, m.
double sway(const Mount& m, const Pose& pose, double turned, Length distance, double moved) {
  const Beam from = perception::beam_of(m, pose);
  const auto moves = [&](double driven) {
    const Beam to = perception::beam_of(m, after(pose, turned, driven));
    return metres(arc(to.axis - from.axis, distance) - across(to.apex - from.apex, to.axis));
  };
  return (moved - moves(0)) / (moves(0.01) - moves(0)) * 0.01;
}

bool outside(const Params& p, const std::vector<Pose>& walk, Vec2 at, double radius) {
  return std::all_of(walk.begin(), walk.end(), [&](const Pose& pose) {
    const Vec2 off = at - vec(pose.at);
    return std::hypot(off.x, off.y) > metres(rim_sweep(p).radius) + radius;
  });
}

/// Positive to the left of this edge of the beam; side is 1 for its left edge, else -1.
double left_of(const Beam& beam, int side, Vec2 at) {
  return sim::cross(towards(radians(beam.axis) + side * radians(beam.half_cone)), at - vec(beam.apex));
}

/// A point that only one reading sees, although the cone sweeps over it: if that one is wrongly clear, none
/// does.
bool draw_seen_once(const Params& p, const std::vector<Pose>& walk, Vec2& at, Random& random) {
  const int steps = static_cast<int>(walk.size());
  for (int attempt = 0; attempt < 200; ++attempt) {
    const size_t then = static_cast<size_t>(2 + random.index(steps - 2));
    const Mount m = mount(p.rangefinders, random.index(3));
    const int way = random.chance(0.5) ? 1 : -1;
    const Beam past = perception::beam_of(m, walk[then]);
    const size_t middle = random.chance(0.5) ? 1 : 2;
    const Beam seen = perception::beam_of(m, walk[then - middle]);
    const Beam before = perception::beam_of(m, walk[then - (3 - middle)]);
    const double reach = metres(p.body.radius) * random.uniform(0, 2.5);
    at = vec(seen.apex) + towards(radians(seen.axis) + random.uniform(-1, 1) * radians(m.half_cone)) * reach;
    if (way * left_of(past, -way, at) < 0 && way * left_of(before, way, at) > 0 && outside(p, walk, at, 0)) {
      return true;
    }
  }
  return false;
}

/// Where a chain is weakest: near the point behind which two readings see nothing between their cones, and on
/// their edges.
Vec2 draw_point(const Params& p, const std::vector<Pose>& walk, double radius, bool once, Random& random) {
  const int steps = static_cast<int>(walk.size());
  const double body = metres(rim_sweep(p).radius);
  Vec2 at;
  if (once && radius == 0 && random.chance(0.5) && draw_seen_once(p, walk, at, random)) return at;
  for (int attempt = 0; attempt < 30; ++attempt) {
    const int first = random.index(steps);
    const int then = std::min(steps - 1, first + 1 + random.index(4) / 3);
    const Mount m = mount(p.rangefinders, random.index(3));
    const Beam old = perception::beam_of(m, walk[static_cast<size_t>(first)]);
    const Beam now = perception::beam_of(m, walk[static_cast<size_t>(then)]);
    const double half = radians(m.half_cone) * (random.chance(0.5) ? 1 : -1);
    const Vec2 lead = towards(radians(old.axis) + half);
    const Vec2 trail = towards(radians(now.axis) - half);
    const Vec2 apex = vec(now.apex);
    const double sine = std::abs(sim::cross(trail, lead));
    if (sine < 1e-3 || random.chance(0.01)) {
      at = apex + trail * (body * random.uniform(0, 3));
      break;
    }
    const Vec2 gap = apex + trail * (sim::cross(vec(old.apex) - apex, lead) / sim::cross(trail, lead));
    // An obstacle of this radius has no part in either cone if it lies this far behind.
    const double tip = radius / std::sin(std::asin(sine) / 2);
    const double hair = std::pow(10.0, random.uniform(-5, -2)) * (random.chance(0.9) ? 1 : -1);
    const double behind = tip + (random.chance(0.7) ? hair : random.uniform(0, body));
    const Vec2 between = lead + trail;
    const Vec2 back = between * (-1 / std::hypot(between.x, between.y));
    const double aside = random.chance(0.7) ? 0 : random.uniform(-1, 1) * std::tan(std::asin(sine) / 2);
    at = gap + back * behind + Vec2{-back.y, back.x} * (aside * (behind - tip));
    const double ahead = sim::dot(at - apex, between);
    if (ahead > 0 && std::hypot(at.x - apex.x, at.y - apex.y) < 4 * body && outside(p, walk, at, radius))
      break;
  }
  if (random.chance(0.1))
    at = at + towards(random.uniform(0, kTurn)) * std::pow(10.0, random.uniform(-9, -2.5));
  return at;
}

/// The point, or the point near it at which an obstacle of this radius all but touches the body.
Vec2 beside_body(const Params& p, const std::vector<Pose>& walk, Vec2 at, double radius) {
  const double nearest = metres(rim_sweep(p).radius) + radius + kTouch;
  for (int pass = 0; pass < 2; ++pass) {
    for (const Pose& pose : walk) {
      const Vec2 off = at - vec(pose.at);
      const double d = std::hypot(off.x, off.y);
      if (d < nearest && d > 0) at = vec(pose.at) + off * (nearest / d);
    }
  }
  return at;
}

}  // namespace

Params draw_robot(Random& random) {
  for (;;) {
    const Params p = draw_any_robot(random);
    if (check(p) == ParamFault::none && rim_sweep(p).needed) return p;
  }
}

Pose after(const Pose& pose, double turned, double driven) {
  return {pose.at + polar(pose.heading, Length::from_raw(static_cast<int32_t>(driven * 1e6))),
          pose.heading + Angle::from_raw(static_cast<uint32_t>(std::llround(turned / kTurn * 0x1p32)))};
}

std::vector<Pose> draw_walk(const Params& p, Random& random) {
  const double cone = 2 * radians(mount(p.rangefinders, random.index(3)).half_cone);
  const double longest = metres(p.body.radius) * 0.2;
  const auto any = [&](int32_t limit) {
    return Length::from_raw(static_cast<int32_t>(random.uniform(-limit, limit)));
  };
  std::vector<Pose> walk{{{any(500000), any(500000)}, Angle::from_raw(static_cast<uint32_t>(random.bits()))}};
  const int steps = 4 + random.index(30);
  const bool turns = random.chance(0.9);
  const bool drives = !turns || random.chance(0.6);
  const Mount side = mount(p.rangefinders, 2 * random.index(2));
  // The edges of a side beam hardly move at the rim of the body, but near the apex they do.
  const bool balanced = random.chance(0.4);
  double turn = 0;
  double drive = 0;
  for (int i = 0; i < steps; ++i) {
    if (i == 0 || random.chance(0.1)) {
      turn = turns ? random.uniform(-1.1, 1.1) * cone * (random.chance(0.5) ? 0.5 : 1) : 0;
      drive = drives ? random.uniform(-longest, longest) : 0;
    }
    if (random.chance(0.05)) turn = -turn;
    double turned = turn * (random.chance(0.7) ? 1 : random.uniform(0, 1.2));
    double driven = drive * (random.chance(0.7) ? 1 : random.uniform(0, 1.2));
    if (random.chance(0.1)) turned = random.uniform(-0.01, 0.01);
    if (balanced && random.chance(0.3)) {
      turned = random.uniform(-0.12, 0.12);
      driven = sway(side, walk.back(), turned, rim_sweep(p).radius, random.uniform(-0.0006, 0.0006));
      driven = std::clamp(driven, -longest * 3, longest * 3);
    }
    walk.push_back(after(walk.back(), turned, driven));
  }
  return walk;
}

void add_obstacle(Cluttered& world, const Params& p, const std::vector<Pose>& walk, bool once,
                  Random& random) {
  Cluttered one;
  const Vec2 body = vec(walk[static_cast<size_t>(random.index(static_cast<int>(walk.size())))].at);
  const int kind = random.index(8);
  const double radius = kind < 2 ? kPole : kind == 2 ? random.uniform(0.001, 0.1) : 0;
  const Vec2 at = beside_body(p, walk, draw_point(p, walk, radius, once, random), radius);
  if (radius > 0) {
    one.discs.push_back({at, radius});
  } else if (kind < 6) {
    one.segments.push_back({at, at});
  } else if (kind == 6) {
    one.segments.push_back({at, at + (at - body) * random.uniform(0.001, 2)});
  } else {
    one.segments.push_back({at, draw_point(p, walk, 0, once, random)});
  }
  for (const Pose& pose : walk) {
    if (sim::clearance(one.view(), vec(pose.at), 0, metres(rim_sweep(p).radius)) <= 0) return;
  }
  world.discs.insert(world.discs.end(), one.discs.begin(), one.discs.end());
  world.segments.insert(world.segments.end(), one.segments.begin(), one.segments.end());
}

void align(Cluttered& world, std::vector<Pose>& walk, int32_t cell_um, double slack, Random& random) {
  if (world.discs.empty() && world.segments.empty()) return;
  const bool disc = !world.discs.empty();
  const Vec2 at = disc ? world.discs[0].center : world.segments[0].a;
  const double reach = disc ? world.discs[0].radius : 0;
  const auto shift = [&](double x) {
    const double inset = slack - reach + std::pow(10.0, random.uniform(-6, -2.5));
    const double wanted = random.chance(0.5) ? inset : cell_um * 1e-6 - inset;
    const double now = std::fmod(x, cell_um * 1e-6);
    return static_cast<int32_t>(std::lround((wanted - now) * 1e6));
  };
  const Vec by{Length::from_raw(shift(at.x)), Length::from_raw(shift(at.y))};
  for (Pose& pose : walk) pose.at = pose.at + by;
  for (sim::Disc& d : world.discs) d.center = d.center + vec(by);
  for (sim::Segment& s : world.segments) s = {s.a + vec(by), s.b + vec(by)};
}

}  // namespace whisker::test

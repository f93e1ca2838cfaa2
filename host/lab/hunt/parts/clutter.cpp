#include "host/lab/hunt/parts/clutter.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/run/spec.hpp"
#include "host/harness/sim/cone.hpp"

namespace whisker::hunt {
namespace {

using sim::Vec2;

/// Near the body, on the corner of a cell, or on the edge of a cone.
Vec2 draw_point(Dice& dice, const Params& p, const Pose& pose) {
  const double cell = metres(grid_cell(p)), share = dice.uniform(0, 1);
  const double reach = metres(p.body.radius) + share * share * 20 * cell;
  const double hair = dice.chance(0.5) ? 0 : dice.log_uniform(1e-9, 1e-3) * (dice.chance(0.5) ? 1 : -1);
  const Vec2 near = vec(pose.at) + dice.direction() * reach;
  if (dice.chance(0.4)) return near;
  if (dice.chance(0.4))
    return {std::round(near.x / cell) * cell + hair, std::round(near.y / cell) * cell + hair};
  const perception::Beam beam = perception::beam_of(mount(p.rangefinders, dice.index(3)), pose);
  const double edge = radians(beam.axis) + radians(beam.half_cone) * (dice.chance(0.5) ? 1 : -1) + hair;
  return vec(beam.apex) + Vec2{std::cos(edge), std::sin(edge)} * reach;
}

double from_segment(Vec2 p, const sim::Segment& s) {
  const Vec2 way = s.b - s.a;
  const double squared = sim::dot(way, way);
  const double on = squared > 0 ? std::clamp(sim::dot(p - s.a, way) / squared, 0.0, 1.0) : 0;
  return std::hypot(p.x - s.a.x - on * way.x, p.y - s.a.y - on * way.y);
}

/// A part of the segment lies in the square.
bool crosses(const Square& square, const sim::Segment& s) {
  double first = 0, last = 1;
  const auto cut = [&](double from, double way, double low, double high) {
    if (way == 0) return low <= from && from <= high;
    const double a = (low - from) / way, b = (high - from) / way;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
    return first <= last;
  };
  return cut(s.a.x, s.b.x - s.a.x, square.low.x, square.high.x) &&
         cut(s.a.y, s.b.y - s.a.y, square.low.y, square.high.y);
}

}  // namespace

sim::WorldView Clutter::view() const {
  sim::WorldView v;
  v.discs = discs.data();
  v.disc_count = discs.size();
  v.segments = segments.data();
  v.segment_count = segments.size();
  return v;
}

double Clutter::distance(Vec2 at) const {
  double least = 1e9;
  for (const sim::Disc& d : discs) least = std::min(least, length_of(d.center - at) - d.radius);
  for (const sim::Segment& s : segments) least = std::min(least, from_segment(at, s));
  return least;
}

Clutter draw_clutter(Dice& dice, const Params& p, const Pose& pose, double free_m) {
  Clutter world;
  for (int i = dice.index(7); i > 0; --i) {
    Clutter one;
    const Vec2 at = draw_point(dice, p, pose);
    switch (dice.index(4)) {
      case 0: one.discs.push_back({at, 0.0005}); break;
      case 1: one.discs.push_back({at, dice.uniform(0.001, 0.2)}); break;
      case 2: one.segments.push_back({at, at + dice.direction() * dice.log_uniform(1e-4, 1)}); break;
      default: one.segments.push_back({at, draw_point(dice, p, pose)}); break;
    }
    if (one.reaches(vec(pose.at), free_m)) continue;
    world.discs.insert(world.discs.end(), one.discs.begin(), one.discs.end());
    world.segments.insert(world.segments.end(), one.segments.begin(), one.segments.end());
  }
  return world;
}

double range_m(const Params& p, const Clutter& world, const sim::Pose& pose, int beam) {
  const sim::BeamSpec mounted = sim::robot_spec(p).beams[beam];
  const double axis = pose.heading + mounted.angle;
  const Vec2 ahead{std::cos(pose.heading), std::sin(pose.heading)}, left{-ahead.y, ahead.x};
  const sim::Cone cone{pose.at + ahead * mounted.x + left * mounted.y,
                       {std::cos(axis), std::sin(axis)},
                       std::cos(mounted.cone_half_width),
                       std::sin(mounted.cone_half_width)};
  return sim::range(cone, world.view(), 0, mounted.max_range);
}

perception::ConeObservation look(const Params& p, const Clutter& world, const Pose& pose, int beam) {
  const double d = range_m(p, world, {vec(pose.at), radians(pose.heading)}, beam);
  perception::ConeObservation seen;
  seen.number = static_cast<std::int8_t>(beam);
  seen.beam = perception::beam_of(mount(p.rangefinders, beam), pose);
  seen.hit = d < metres(p.rangefinders.max_range);
  seen.free = seen.hit ? millimetres(static_cast<int>(std::floor(d * 1000 + 0.5))) : p.rangefinders.max_range;
  return seen;
}

Angle draw_angle(Dice& dice) {
  if (dice.chance(0.3)) {
    return Angle::turns(dice.index(8), 8) + Angle::from_raw(static_cast<std::uint32_t>(dice.index(5)) - 2U);
  }
  return Angle::from_raw(static_cast<std::uint32_t>(dice.bits()));
}

Pose draw_pose(Dice& dice) {
  const std::int32_t far = dice.chance(0.2) ? 900000000 : 1000000;
  const auto length = [&] { return Length::from_raw(dice.index(2 * far) - far); };
  const Length x = length(), y = length();
  return {{x, y}, draw_angle(dice)};
}

Params draw_eyes(Dice& dice) {
  while (true) {
    Params p;
    if (dice.chance(0.4)) return p;
    p.body.radius = millimetres(40 + dice.index(140));
    p.body.track = p.body.radius * 3 / 2;
    p.rangefinders.cone = Angle::turns(40 + dice.index(400), 3600);
    p.rangefinders.side_angle = Angle::turns(100 + dice.index(700), 3600);
    if (dice.chance(0.5)) p.rangefinders.offset = p.body.radius * dice.index(100) / 100;
    if (dice.chance(0.5)) p.rangefinders.max_range = millimetres(400 + dice.index(1600));
    if (check(p) == ParamFault::none) return p;
  }
}

Square Square::around(Vec at, Length cell) {
  const auto low = [&](Length x) {
    const std::int32_t n = (x.raw() >= 0 ? x.raw() : x.raw() - cell.raw() + 1) / cell.raw();
    return static_cast<double>(n) * metres(cell);
  };
  const Vec2 corner{low(at.x), low(at.y)};
  return {corner, corner + Vec2{metres(cell), metres(cell)}};
}

double Square::nearest(Vec2 p) const {
  return std::hypot(p.x - std::clamp(p.x, low.x, high.x), p.y - std::clamp(p.y, low.y, high.y));
}

double Square::farthest(Vec2 p) const {
  return std::hypot(std::max(std::fabs(p.x - low.x), std::fabs(p.x - high.x)),
                    std::max(std::fabs(p.y - low.y), std::fabs(p.y - high.y)));
}

bool Square::covered(const Clutter& world, double slack_m) const {
  const Square inner{low + Vec2{slack_m, slack_m}, high - Vec2{slack_m, slack_m}};
  for (const sim::Disc& d : world.discs) {
    if (inner.nearest(d.center) <= d.radius) return true;
  }
  return std::any_of(world.segments.begin(), world.segments.end(),
                     [&](const sim::Segment& s) { return crosses(inner, s); });
}

}  // namespace whisker::hunt

#include <algorithm>

#include "host/harness/scenario/shapes.hpp"
#include "host/harness/worlds/direction.hpp"
#include "host/harness/worlds/draw.hpp"

namespace whisker::worlds {
namespace {

using sim::Vec2;

Vec2 turned(Vec2 p, Vec2 axis) { return {p.x * axis.x - p.y * axis.y, p.x * axis.y + p.y * axis.x}; }

/// A trap in its own coordinates.
struct Plan {
  std::vector<std::vector<Vec2>> solids;
  Vec2 start, goal;
};

/// Turns the plan by the heading and moves its start to the origin.
void place(Scenario& s, const Plan& plan, double heading_deg) {
  const Vec2 axis = direction(heading_deg);
  const auto at = [&](Vec2 p) { return tidy(turned(p - plan.start, axis)); };
  s.start.at = {0, 0};
  s.goal.at = at(plan.goal);
  for (const auto& solid : plan.solids) {
    s.polygons.emplace_back();
    for (const Vec2 p : solid) s.polygons.back().push_back(at(p));
  }
}

using Line = std::vector<Vec2>;

Line spiral_line(Random& random) {
  const double pitch = random.uniform(0.45, 0.9);
  const int legs = 4 + random.index(6);
  // The centre of the pocket is the origin; each pair of legs is one pitch longer than the last.
  Line line{{-pitch / 2, -pitch / 2}};
  Vec2 heading{1, 0};
  for (int i = 0; i < legs; ++i) {
    line.push_back(line.back() + heading * (pitch * (1 + i / 2)));
    heading = {-heading.y, heading.x};
  }
  return line;
}

std::vector<Line> nested_us(Random& random) {
  double half_width = random.uniform(0.6, 1.2) / 2;
  double back = -random.uniform(0.3, 0.75);
  double mouth = random.uniform(0.3, 0.75);
  double opening = 1;
  std::vector<Line> us;
  const int count = 2 + random.index(2);
  for (int i = 0; i < count; ++i) {
    us.push_back({{opening * mouth, half_width},
                  {opening * back, half_width},
                  {opening * back, -half_width},
                  {opening * mouth, -half_width}});
    // The next one faces the other way: its back is one gap before the mouth of this one.
    const double gap = random.uniform(0.45, 0.9);
    const double next_back = -(mouth + gap);
    mouth = -back + random.uniform(0.2, 1.0);
    back = next_back;
    half_width += gap;
    opening = -opening;
  }
  return us;
}

Line g_line(Random& random) {
  const double half = random.uniform(1.5, 3) / 2;
  const double opening = random.uniform(0.45, 0.9);
  const double lip_out = random.uniform(0.1, 0.5);
  const double lip_in = random.uniform(0.3, half);
  return {{half + lip_out, half}, {-half, half},          {-half, -half},
          {half, -half},          {half, half - opening}, {half - lip_in, half - opening}};
}

std::vector<Line> trap_lines(Random& random) {
  switch (random.index(3)) {
    case 0: return {spiral_line(random)};
    case 1: return nested_us(random);
    default: return {g_line(random)};
  }
}

}  // namespace

std::vector<Vec2> bar(Vec2 a, Vec2 b, double thickness) {
  const Vec2 along = (b - a) * (thickness / 2 / distance(a, b));
  const Vec2 aside{-along.y, along.x};
  return {a - along - aside, b + along - aside, b + along + aside, a - along + aside};
}

void draw_u_trap(Scenario& s, Random& random) {
  constexpr double kThick = 0.1;
  const double half = random.uniform(0.6, 4) / 2;
  const double depth = random.uniform(0.5, 3);
  // The back wall's inner face is x = 0; the U opens towards +x.
  Plan plan;
  plan.solids = {{{-kThick, -half - kThick},
                  {depth, -half - kThick},
                  {depth, -half},
                  {0, -half},
                  {0, half},
                  {depth, half},
                  {depth, half + kThick},
                  {-kThick, half + kThick}}};
  const Vec2 behind = direction(180 + random.uniform(-30, 30));
  plan.goal = Vec2{-kThick, 0} + behind * random.uniform(0.3, 3);
  if (random.index(3) == 0) {
    const double x = random.uniform(kKeptFree, depth);
    plan.start = {x, random.uniform(kKeptFree - half, half - kKeptFree)};
  } else {
    const Vec2 ahead = direction(random.uniform(-60, 60));
    plan.start = Vec2{depth / 2, 0} + ahead * random.uniform(3, 7);
  }
  place(s, plan, random.uniform(0, 360));
}

void draw_spiral(Scenario& s, Random& random) {
  constexpr double kThick = 0.04;
  Plan plan;
  double extent = 0;
  for (const Line& line : trap_lines(random)) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      extent = std::max(extent, distance({0, 0}, line[i]));
      if (i > 0) plan.solids.push_back(bar(line[i - 1], line[i], kThick));
    }
  }
  plan.start = {0, 0};
  const Vec2 outward = direction(random.uniform(0, 360));
  plan.goal = outward * (extent + random.uniform(0.5, 2));
  if (random.chance(0.5)) std::swap(plan.start, plan.goal);
  place(s, plan, random.uniform(0, 360));
}

}  // namespace whisker::worlds

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/shapes.hpp"
#include "host/harness/worlds/direction.hpp"
#include "host/harness/worlds/draw.hpp"

namespace whisker::worlds {
namespace {

using sim::Vec2;

constexpr double kLow = -0.5;
constexpr double kHigh = 8.5;

void draw_field(Scenario& s, Random& random, int discs, bool box) {
  s.start.at = {0, 0};
  s.goal.at = {8, 8};
  if (box) s.bounds = Bounds{{-0.8, -0.8}, {8.8, 8.8}};
  add_discs(s, random, {discs, 0.15, box ? 0.6 : 0.8, kLow, kHigh});
}

/// A closed wall: a regular polygon with 3 to 7 sides around the point.
std::vector<Vec2> fence(Random& random, Vec2 around) {
  const int sides = 3 + random.index(5);
  const double apothem = random.uniform(0.4, 1.4);
  const double corner = apothem / direction(180.0 / sides).x;
  const double turn = random.uniform(0, 360);
  std::vector<Vec2> points;
  for (int i = 0; i < sides; ++i)
    points.push_back(tidy(around + direction(turn + 360.0 * i / sides) * corner));
  points.push_back(points.front());
  return points;
}

/// A fence that extends beyond the box.
std::vector<Vec2> fence_across(Random& random, Vec2 around, const Bounds& box) {
  for (;;) {
    const std::vector<Vec2> points = fence(random, around);
    for (const Vec2 p : points) {
      if (p.x < box.min.x || p.y < box.min.y || p.x > box.max.x || p.y > box.max.y) return points;
    }
  }
}

/// Removes a piece from one side of a closed wall. The gap may lie outside the box: then there is no path.
void open_gap(std::vector<Vec2>& fence, Random& random) {
  const std::size_t sides = fence.size() - 1;
  const auto side = static_cast<std::size_t>(random.index(static_cast<int>(sides)));
  const Vec2 a = fence[side];
  const Vec2 b = fence[side + 1];
  const double length = distance(a, b);
  const double width = std::min(random.uniform(0.26, 0.6), length / 2);
  constexpr double kPost = 0.01;  // of the side that remains at least, so that no two points coincide
  const double begin = random.uniform(kPost, length - width - kPost);
  std::vector<Vec2> open{tidy(a + (b - a) * ((begin + width) / length))};
  for (std::size_t i = 1; i <= sides; ++i) open.push_back(fence[(side + i) % sides]);
  open.push_back(tidy(a + (b - a) * (begin / length)));
  fence = open;
}

sim::Disc disc_over(Random& random, Vec2 point) {
  constexpr double kDepth = 0.15;  // of the point below the disc's surface: more than the goal's tolerance
  const double radius = tidy(random.uniform(0.3, 0.8));
  const double off = random.uniform(0, radius - kDepth);
  return {tidy(point + direction(random.uniform(0, 360)) * off), radius};
}

}  // namespace

double tidy(double metres) { return std::floor(metres * 1e4 + 0.5) / 1e4 + 0.0; }
Vec2 tidy(Vec2 p) { return {tidy(p.x), tidy(p.y)}; }

void add_discs(Scenario& s, Random& random, const DiscField& f) {
  for (int added = 0; added < f.count;) {
    const double x = random.uniform(f.low, f.high);
    const double y = random.uniform(f.low, f.high);
    const sim::Disc disc{tidy(Vec2{x, y}), tidy(random.uniform(f.radius_min, f.radius_max))};
    const double kept_free = disc.radius + kKeptFree;
    if (distance(disc.center, s.start.at) < kept_free || distance(disc.center, s.goal.at) < kept_free)
      continue;
    s.discs.push_back(disc);
    ++added;
  }
}

void draw_discs(Scenario& s, Random& random, const Options& o) {
  draw_field(s, random, o.discs.value_or(30), o.box);
}

void draw_poles(Scenario& s, Random& random, const Options& o) {
  draw_field(s, random, o.discs.value_or(12), o.box);
  add_discs(s, random, {100, 0.01, 0.03, kLow, kHigh});
}

void draw_enclosed(Scenario& s, Random& random, const Options& o) {
  const int usual = random.chance(0.5) ? 15 : 30;
  draw_field(s, random, o.discs.value_or(usual), o.box);
  const int way = random.index(3);
  if (way == 0) s.walls.push_back(fence(random, s.goal.at));
  if (way == 1) s.walls.push_back(fence(random, s.start.at));
  if (way == 2) s.discs.push_back(disc_over(random, s.goal.at));
}

void draw_enclosed_at_wall(Scenario& s, Random& random, const Options& o) {
  const int usual = random.chance(0.5) ? 15 : 30;
  draw_field(s, random, o.discs.value_or(usual), true);
  s.walls.push_back(fence_across(random, s.goal.at, *s.bounds));
}

void draw_gap_at_wall(Scenario& s, Random& random, const Options& o) {
  draw_enclosed_at_wall(s, random, o);
  open_gap(s.walls.back(), random);
}

}  // namespace whisker::worlds

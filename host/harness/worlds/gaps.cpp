#include "host/harness/worlds/direction.hpp"
#include "host/harness/worlds/draw.hpp"

namespace whisker::worlds {
namespace {

using sim::Vec2;

constexpr double kWallThickness = 0.02;
constexpr double kDiscRadius = 0.2;
constexpr double kHalfBox = 2.5;
constexpr double kFar = 4.5;  // from the gap, a wall at the steepest angle is outside the box

/// A wall across the box with a gap around its middle; start and goal lie on either side.
struct Barrier {
  Vec2 middle, along;
  double half_gap;
};

Barrier draw_barrier(Scenario& s, Random& random, const Options& o) {
  s.start.at = {0, 0};
  s.goal.at = {4, 0};
  s.bounds = Bounds{{-1.5, -kHalfBox}, {5.5, kHalfBox}};
  constexpr double kSteepestDeg = 34.3775;  // 0.6 rad
  const double upright = 90 + random.uniform(-kSteepestDeg, kSteepestDeg);
  const Vec2 middle{2, random.uniform(-0.8, 0.8)};
  return {middle, direction(upright), o.gap_m.value_or(kGap) / 2};
}

void add_wall(Scenario& s, const Barrier& barrier, double from) {
  for (const double side : {-1.0, 1.0}) {
    // A bar extends half its thickness beyond its ends.
    const Vec2 a = barrier.middle + barrier.along * (side * (from + kWallThickness / 2));
    s.polygons.emplace_back();
    for (const Vec2 p : bar(a, barrier.middle + barrier.along * (side * kFar), kWallThickness)) {
      s.polygons.back().push_back(tidy(p));
    }
  }
}

}  // namespace

void draw_gap(Scenario& s, Random& random, const Options& o) {
  const Barrier barrier = draw_barrier(s, random, o);
  add_wall(s, barrier, barrier.half_gap);
}

void draw_disc_gap(Scenario& s, Random& random, const Options& o) {
  const Barrier barrier = draw_barrier(s, random, o);
  const double off = barrier.half_gap + kDiscRadius;
  for (const double side : {-1.0, 1.0}) {
    s.discs.push_back({tidy(barrier.middle + barrier.along * (side * off)), kDiscRadius});
  }
  add_wall(s, barrier, off);
}

}  // namespace whisker::worlds

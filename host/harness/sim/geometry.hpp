/// Plane geometry in metres, double precision. x ahead of heading 0, y to its left.
#pragma once

namespace whisker::sim {

struct Vec2 {
  double x = 0;
  double y = 0;
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(Vec2 a, double k) { return {a.x * k, a.y * k}; }
};

constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

struct Pose {
  Vec2 at;
  double heading = 0;  ///< rad, counter-clockwise from +x, unbounded
};

struct Disc {
  Vec2 center;
  double radius = 0;
};

struct Segment {
  Vec2 a;
  Vec2 b;
};

}  // namespace whisker::sim

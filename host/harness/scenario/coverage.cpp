#include "host/harness/scenario/coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/params/relations.hpp"

namespace whisker {
namespace {

constexpr double kRadiansADegree = 3.14159265358979323846 / 180;
constexpr int kSamples = 400;  // of a radius
// The local grid reaches at least as far ahead of the body: half its window, whose middle is 3 cells ahead.
constexpr int kCellsAhead = kHalfWindow + 3;

double metres(Length l) { return l.raw() * 1e-6; }
double degrees(Angle a) { return a.wrapped() * (180.0 / 2147483648.0); }

struct Cone {
  double x, y, axis_deg, half_deg, reach_m;
};

Cone cone(const Params& p, const Sensor& sensor, int beam) {
  const Mount m = mount(p.rangefinders, beam);
  double half = degrees(m.half_cone), reach = metres(proving_range(p.rangefinders));
  reach = std::min(reach, sensor.max_range_m.value_or(reach));
  if (sensor.cone_deg) {
    const double wide = *sensor.cone_deg, far = std::min(wide, sensor.cone_far_deg.value_or(wide));
    half = std::min(half, (wide - (wide - far) * reach / sensor.max_range_m.value_or(reach)) / 2);
  }
  return {metres(m.apex.x), metres(m.apex.y), degrees(m.axis), half, reach};
}

/// Stretch of a line along the course; empty if from > to.
struct Stretch {
  double from, to;
  /// Keeps where slope * x + offset >= 0.
  void keep(double slope, double offset) {
    if (slope > 0) {
      from = std::max(from, -offset / slope);
    } else if (slope < 0) {
      to = std::min(to, -offset / slope);
    } else if (offset < 0) {
      to = from - 1;
    }
  }
};

/// Whether the cone sees a point of the line at distance y to the left of the course.
bool sees(const Cone& c, double y, Stretch x) {
  const double dy = y - c.y;
  for (const double side : {1.0, -1.0}) {
    // side * cross(edge, point - apex) <= 0 inside.
    const double edge = (c.axis_deg + side * c.half_deg) * kRadiansADegree;
    const double ex = std::cos(edge), ey = std::sin(edge);
    x.keep(side * ey, -side * (ex * dy + ey * c.x));
  }
  const double span = c.reach_m * c.reach_m - dy * dy;
  if (span < 0) return false;
  x.from = std::max(x.from, c.x - std::sqrt(span));
  x.to = std::min(x.to, c.x + std::sqrt(span));
  return x.from <= x.to;
}

/// The widest on this side of the course.
Strip unseen_beside(const Params& p, const Cone (&cones)[3], bool left) {
  const double swept = metres(reach(p).guard), step = metres(p.body.radius) / kSamples;
  const double window = kCellsAhead * metres(grid_cell(p)), ahead = seen_ahead_m(p);
  Strip widest{0, 0, left}, now = widest;
  for (int i = 0; (i + 0.5) * step < swept; ++i) {
    const double y = (i + 0.5) * step;
    const double from = std::min(std::sqrt(swept * swept - y * y) + ahead, window);
    const Stretch x{from, window};
    const bool seen = std::any_of(cones, cones + 3, [&](const Cone& c) { return sees(c, left ? y : -y, x); });
    if (seen) {
      now.inner_m = now.outer_m = (i + 1) * step;
    } else {
      now.outer_m = std::min((i + 1) * step, swept);
      if (now.width() > widest.width()) widest = now;
    }
  }
  return widest;
}

}  // namespace

double outer_edge_deg(const Params& params, const Sensor& sensor, bool left) {
  double outermost = -180;
  for (int i = 0; i < 3; ++i) {
    const Cone c = cone(params, sensor, i);
    outermost = std::max(outermost, (left ? c.axis_deg : -c.axis_deg) + c.half_deg);
  }
  return outermost;
}

double needed_incidence_deg(const Params& params, const Sensor& sensor) {
  std::array<Cone, 3> cones{cone(params, sensor, 0), cone(params, sensor, 1), cone(params, sensor, 2)};
  const auto low = [](const Cone& c) { return c.axis_deg - c.half_deg; };
  const auto high = [](const Cone& c) { return c.axis_deg + c.half_deg; };
  std::sort(cones.begin(), cones.end(), [&](const Cone& a, const Cone& b) { return low(a) < low(b); });
  double needed = low(cones[0]) + 90, seen_to = high(cones[0]);
  for (const Cone& c : cones) {
    needed = std::max(needed, (low(c) - seen_to) / 2);
    seen_to = std::max(seen_to, high(c));
  }
  return std::max(needed, 90 - seen_to);
}

bool wall_in_time(const Params& params, const Sensor& sensor, double normal_deg, double incidence_deg) {
  const double w = normal_deg * kRadiansADegree,
               away = metres(reach(params).guard) + seen_ahead_m(params) * std::cos(w);
  for (int i = 0; i < 3; ++i) {
    const Cone c = cone(params, sensor, i);
    const double ray = std::clamp(normal_deg, c.axis_deg - c.half_deg, c.axis_deg + c.half_deg);
    const double off = std::fabs(ray - normal_deg);
    if (off > incidence_deg || off >= 90) continue;
    const double range = (away - c.x * std::cos(w) - c.y * std::sin(w)) / std::cos(off * kRadiansADegree);
    if (range <= c.reach_m && range >= metres(params.rangefinders.min_range)) return true;
  }
  return false;
}

double seen_incidence_deg(const Params& params, const Sensor& sensor) {
  return std::min(degrees(params.rangefinders.incidence), sensor.incidence_deg);
}

double rim_ahead_m(const Params& params, int beam) {
  const Mount m = mount(params.rangefinders, beam);
  const double ahead = metres(along(m.apex, m.axis)), beside = metres(across(m.apex, m.axis));
  const double radius = metres(params.body.radius);
  return std::sqrt(std::max(0.0, radius * radius - beside * beside)) - ahead;
}

double seen_ahead_m(const Params& params) {
  return metres(min(relations::stopping_distance(params), reach(params).probe));
}

Strip unseen_strip(const Params& params, const Sensor& sensor) {
  const Cone cones[3] = {cone(params, sensor, 0), cone(params, sensor, 1), cone(params, sensor, 2)};
  const Strip left = unseen_beside(params, cones, true), right = unseen_beside(params, cones, false);
  return right.width() > left.width() ? right : left;
}

bool hides_obstacles(const Strip& strip, const Params& params) {
  return strip.width() > metres(params.boundary.guard_margin);
}

}  // namespace whisker

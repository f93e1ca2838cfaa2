#include "host/lab/scanner/reference_path.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "host/harness/sim/elementary.hpp"
#include "host/harness/sim/world.hpp"
#include "host/lab/paths/shortest.hpp"
#include "host/lab/scanner/all_round_scan.hpp"

namespace whisker::scanner {
namespace {

using sim::Vec2;

constexpr double kApart = 0.01;  // m between the points of a path
constexpr int kPointsALook = 5;
constexpr double kSlack = 0.9e-9;  // m; less than the tolerance of a shortest path
constexpr int kMostWays = 100000;

struct Point {
  Vec2 at;
  double step_m;  // path length since the previous point
};

Vec2 on(const paths::Leg& leg, double share) {
  if (leg.turn_rad == 0) return leg.from + (leg.to - leg.from) * share;
  const sim::SinCos turn = sim::sin_cos(leg.turn_rad * share);
  const Vec2 arm = leg.from - leg.around.center;
  return leg.around.center + Vec2{arm.x * turn.cos - arm.y * turn.sin, arm.x * turn.sin + arm.y * turn.cos};
}

std::vector<Point> points(const paths::Way& way) {
  std::vector<Point> points;
  for (const paths::Leg& leg : way.legs) {
    const double length = paths::length_m(leg);
    const int count = static_cast<int>(std::ceil(length / kApart));
    for (int i = 1; i < count; ++i)
      points.push_back({on(leg, static_cast<double>(i) / count), length / count});
    points.push_back({leg.to, length / std::max(count, 1)});
  }
  return points;
}

bool fits(const World& world, Vec2 at, double radius_m) {
  const sim::WorldView view{nullptr, 0, world.segments.data(), world.segments.size()};
  return sim::clearance(view, at, 0, radius_m) >= -kSlack;
}

class Drive {
 public:
  Drive(const World& outlines, Vec2 from, double radius_m, double range_m)
      : world_(outlines), radius_(radius_m), range_(range_m), seen_(outlines.segments), at_(from) {
    scan_all_round(world_.segments, at_, range_, seen_);
  }

  /// True: reached. False: the seen outlines leave no path.
  bool to(Vec2 goal) {
    for (int ways = 0; ways < kMostWays; ++ways) {
      seen_.take_new();
      const auto way = paths::shortest_way(seen_.known(), at_, goal, radius_);
      if (!way) return false;
      if (follow(points(*way))) return true;
    }
    throw std::runtime_error("the scanner's reference does not end");
  }

  double driven_m() const { return driven_m_; }

 private:
  /// True: followed to its end. False: an obstacle that was not known is in the way.
  bool follow(const std::vector<Point>& way) {
    for (std::size_t next = 0; next < way.size(); ++next) {
      if (next % kPointsALook == kPointsALook - 1 && !still_free(way, next)) return false;
      if (!fits(world_, way[next].at, radius_)) {
        // The obstacle was hidden until the body met it.
        seen_.add_near(way[next].at, radius_);
        return false;
      }
      at_ = way[next].at;
      driven_m_ += way[next].step_m;
    }
    return true;
  }

  bool still_free(const std::vector<Point>& way, std::size_t next) {
    scan_all_round(world_.segments, at_, range_, seen_);
    const World found = seen_.take_new();
    return std::all_of(way.begin() + static_cast<std::ptrdiff_t>(next), way.end(),
                       [&](const Point& p) { return fits(found, p.at, radius_); });
  }

  const World& world_;  // outlines only
  double radius_, range_;
  SeenOutlines seen_;
  Vec2 at_;
  double driven_m_ = 0;
};

}  // namespace

ReferencePath drive(const World& world, Vec2 from, Vec2 to, double radius_m, double range_m) {
  World outline;
  outline.segments = outlines(world);
  Drive drive(outline, from, radius_m, range_m);
  const bool reached = drive.to(to);
  return {reached, drive.driven_m(), paths::shortest_path(outline, from, to, radius_m)};
}

}  // namespace whisker::scanner

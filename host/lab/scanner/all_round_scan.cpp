#include "host/lab/scanner/all_round_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/shapes.hpp"
#include "host/harness/sim/distance.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::scanner {
namespace {

using sim::Vec2;

constexpr int kRays = 1440;
constexpr double kApart = 2 * sim::kPi / kRays;  // rad
constexpr double kSlack = 1e-9;                  // of kApart; no ray passes between two adjacent segments

std::size_t index(int ray) { return static_cast<std::size_t>((ray % kRays + kRays) % kRays); }

Vec2 direction(int ray) {
  static const auto directions = [] {
    std::array<Vec2, kRays> all;
    for (int i = 0; i < kRays; ++i) {
      const sim::SinCos angle = sim::sin_cos(i * kApart);
      all[static_cast<std::size_t>(i)] = {angle.cos, angle.sin};
    }
    return all;
  }();
  return directions[index(ray)];
}

/// A segment oriented counter-clockwise around the scanner, with the rays that it may stop.
struct Target {
  std::size_t segment;
  Vec2 to, side;  // to its start, and along it
  bool reversed;  // it starts at the segment's end
  int first, last;
};

Target target(const sim::Segment& s, std::size_t segment, Vec2 from) {
  Vec2 a = s.a - from, b = s.b - from;
  const bool reversed = sim::cross(a, b) < 0;
  if (reversed) std::swap(a, b);
  const double begins = bearing({}, a) / kApart;
  const double width = sim::arc_tangent(sim::cross(a, b), sim::dot(a, b)) / kApart;
  return {segment,
          a,
          b - a,
          reversed,
          static_cast<int>(std::ceil(begins - kSlack)),
          static_cast<int>(std::floor(begins + width + kSlack))};
}

struct Hit {
  double away_m = 0;
  double share = 0;
};

Hit hit(const Target& t, int ray) {
  const double turn = sim::cross(direction(ray), t.side);
  const double share = turn == 0 ? 0 : std::clamp(sim::cross(t.to, direction(ray)) / turn, 0.0, 1.0);
  const Vec2 at = t.to + t.side * share;
  return {sim::square_root(sim::dot(at, at)), share};
}

class Scan {
 public:
  Scan(const std::vector<sim::Segment>& outlines, Vec2 from, double range_m) : range_(range_m) {
    rays_.fill({range_m, outlines.size()});
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      if (sim::distance(from, outlines[i]) > range_m) continue;
      targets_.push_back(target(outlines[i], i, from));
      stop_rays(targets_.back());
    }
  }

  void add_to(SeenOutlines& seen) const {
    for (const Target& t : targets_) {
      if (t.first > t.last) tell_slim(t, seen);
      for (int ray = t.first; ray <= t.last; ++ray) {
        if (!sees(ray, t)) continue;
        const int begin = ray;
        while (ray < t.last && sees(ray + 1, t)) ++ray;
        // A segment that ends between two rays is seen up to its end.
        const double from = begin == t.first && in_range(t.to) ? 0 : hit(t, begin).share;
        const double to = ray == t.last && in_range(t.to + t.side) ? 1 : hit(t, ray).share;
        add_to(t, from, to, seen);
      }
    }
  }

 private:
  struct Ray {
    double away_m;
    std::size_t segment;
  };

  bool sees(int ray, const Target& t) const { return rays_[index(ray)].segment == t.segment; }
  bool in_range(Vec2 to) const { return sim::dot(to, to) <= range_ * range_; }

  void stop_rays(const Target& t) {
    for (int ray = t.first; ray <= t.last; ++ray) {
      const double away_m = hit(t, ray).away_m;
      if (away_m < rays_[index(ray)].away_m) rays_[index(ray)] = {away_m, t.segment};
    }
  }

  /// A segment between two rays, or along a line of sight.
  void tell_slim(const Target& t, SeenOutlines& seen) const {
    const Vec2 end = t.to + t.side;
    const bool begins_nearer = sim::dot(t.to, t.to) <= sim::dot(end, end);
    const Vec2 near = begins_nearer ? t.to : end;
    if (!in_range(near) || rays_[index(t.first)].away_m < sim::square_root(sim::dot(near, near))) return;
    const double share = begins_nearer ? 0 : 1;
    add_to(t, share, share, seen);
  }

  static void add_to(const Target& t, double from, double to, SeenOutlines& seen) {
    seen.add(t.segment, t.reversed ? Span{1 - to, 1 - from} : Span{from, to});
  }

  double range_;
  std::array<Ray, kRays> rays_;
  std::vector<Target> targets_;
};

}  // namespace

void scan_all_round(const std::vector<sim::Segment>& outlines, Vec2 from, double range_m,
                    SeenOutlines& seen) {
  Scan(outlines, from, range_m).add_to(seen);
}

}  // namespace whisker::scanner

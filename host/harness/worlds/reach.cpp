#include "host/harness/worlds/reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "host/harness/scenario/shapes.hpp"

namespace whisker::worlds {
namespace {

using sim::Vec2;

constexpr double kCell = 0.02;
constexpr double kDiagonal = 1.4142135623730951;
constexpr double kBucket = 0.25;
constexpr double kMostCells = 4e6;

struct Box {
  Vec2 min, max;
  void cover(Vec2 p, double around) {
    min = {std::min(min.x, p.x - around), std::min(min.y, p.y - around)};
    max = {std::max(max.x, p.x + around), std::max(max.y, p.y + around)};
  }
};

Box extent(const World& world, Vec2 from, Vec2 to, double margin) {
  Box box{from, from};
  box.cover(from, margin);
  box.cover(to, margin);
  for (const sim::Disc& d : world.discs) box.cover(d.center, d.radius + margin);
  for (const sim::Segment& s : world.segments) {
    box.cover(s.a, margin);
    box.cover(s.b, margin);
  }
  if ((box.max.x - box.min.x) * (box.max.y - box.min.y) > kMostCells * kCell * kCell) {
    throw std::length_error("the world is too large to look for a path in it");
  }
  return box;
}

/// Distances to the nearest obstacle, exact up to a cap: each bucket lists obstacles that may be that near.
class Clearance {
 public:
  Clearance(const World& world, Box box, double cap)
      : box_(box),
        cap_(cap),
        columns_(count(box.min.x, box.max.x)),
        rows_(count(box.min.y, box.max.y)),
        buckets_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (const sim::Disc& d : world.discs) {
      Box around{d.center, d.center};
      around.cover(d.center, d.radius + cap);
      each_bucket(around, [&](Bucket& bucket, Vec2 center) {
        if (distance(center, d.center) - d.radius <= reach()) bucket.discs.push_back(d);
      });
    }
    for (const sim::Segment& s : world.segments) {
      Box around{s.a, s.a};
      around.cover(s.a, cap);
      around.cover(s.b, cap);
      each_bucket(around, [&](Bucket& bucket, Vec2 center) {
        if (distance(center, s) <= reach()) bucket.segments.push_back(s);
      });
    }
  }

  double at(Vec2 p) const {
    const Bucket& bucket = buckets_[index(column(p.x), row(p.y))];
    double nearest = cap_;
    for (const sim::Disc& d : bucket.discs) nearest = std::min(nearest, distance(p, d.center) - d.radius);
    for (const sim::Segment& s : bucket.segments) nearest = std::min(nearest, distance(p, s));
    return nearest;
  }

 private:
  struct Bucket {
    std::vector<sim::Disc> discs;
    std::vector<sim::Segment> segments;
  };

  static int count(double low, double high) { return static_cast<int>((high - low) / kBucket) + 1; }
  double reach() const { return cap_ + kBucket * kDiagonal / 2 + 1e-9; }
  int column(double x) const {
    return std::clamp(static_cast<int>((x - box_.min.x) / kBucket), 0, columns_ - 1);
  }
  int row(double y) const { return std::clamp(static_cast<int>((y - box_.min.y) / kBucket), 0, rows_ - 1); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  template <class F>
  void each_bucket(const Box& around, F&& f) {
    for (int r = row(around.min.y); r <= row(around.max.y); ++r) {
      for (int c = column(around.min.x); c <= column(around.max.x); ++c) {
        f(buckets_[index(c, r)], box_.min + Vec2{(c + 0.5) * kBucket, (r + 0.5) * kBucket});
      }
    }
  }

  Box box_;
  double cap_;
  int columns_, rows_;
  std::vector<Bucket> buckets_;
};

/// A grid that contains `from`, so that the wavefront starts exactly there.
class Grid {
 public:
  Grid(const World& world, Vec2 from, Vec2 to, double radius)
      : box_(extent(world, from, to, radius + 4 * kCell)),
        clearance_(world, box_, radius + 2 * kCell),
        from_(from),
        left_(steps(from.x - box_.min.x)),
        below_(steps(from.y - box_.min.y)),
        width_(left_ + steps(box_.max.x - from.x) + 1),
        height_(below_ + steps(box_.max.y - from.y) + 1) {
    gaps_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kUnknown);
  }

  /// Visits every point that is reachable from `from` by steps to the 8 neighbours if `passable(gap, gap of
  /// the neighbour, length)`; stops when `arrived(point, gap)` is true.
  template <class P, class A>
  bool wavefront(P&& passable, A&& arrived) {
    std::vector<std::uint8_t> seen(gaps_.size(), 0);
    std::vector<int> front{below_ * width_ + left_};
    seen[static_cast<std::size_t>(front[0])] = 1;
    while (!front.empty()) {
      const int here = front.back();
      front.pop_back();
      const double gap_here = gap(here);
      if (arrived(point(here), gap_here)) return true;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int x = here % width_ + dx;
          const int y = here / width_ + dy;
          if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
          const int there = y * width_ + x;
          std::uint8_t& mark = seen[static_cast<std::size_t>(there)];
          if (mark != 0) continue;
          if (!passable(gap_here, gap(there), dx != 0 && dy != 0 ? kCell * kDiagonal : kCell)) continue;
          mark = 1;
          front.push_back(there);
        }
      }
    }
    return false;
  }

  double gap_at(Vec2 p) const { return clearance_.at(p); }

 private:
  static constexpr double kUnknown = 1e9;
  static int steps(double length) { return static_cast<int>(length / kCell); }
  Vec2 point(int i) const {
    return from_ + Vec2{(i % width_ - left_) * kCell, (i / width_ - below_) * kCell};
  }
  double gap(int i) {
    double& gap = gaps_[static_cast<std::size_t>(i)];
    if (gap == kUnknown) gap = clearance_.at(point(i));
    return gap;
  }

  Box box_;
  Clearance clearance_;
  Vec2 from_;
  int left_, below_, width_, height_;
  std::vector<double> gaps_;
};

}  // namespace

bool path_proven(const World& world, Vec2 from, Vec2 to, double radius_m) {
  Grid grid(world, from, to, radius_m);
  // The clearance of a straight step is at least the mean of its ends' clearances minus half its length.
  const auto proven = [&](double a, double b, double length) { return a + b - length >= 2 * radius_m; };
  const double gap_to = grid.gap_at(to);
  if (grid.gap_at(from) < radius_m || gap_to < radius_m) return false;
  return grid.wavefront(proven, [&](Vec2 p, double gap) {
    const double last = distance(p, to);
    return last <= kCell && proven(gap, gap_to, last);
  });
}

bool path_ruled_out(const World& world, Vec2 from, Vec2 to, double tolerance_m, double radius_m) {
  Grid grid(world, from, to, radius_m);
  if (grid.gap_at(from) < radius_m) return true;
  // Every point of a path has a grid point this near; that grid point's clearance is smaller by at most this.
  constexpr double kNearest = kCell * kDiagonal / 2;
  return !grid.wavefront([&](double, double b, double) { return b >= radius_m - kNearest; },
                         [&](Vec2 p, double) { return distance(p, to) <= tolerance_m + kNearest; });
}

}  // namespace whisker::worlds

#include "host/lab/paths/inflated.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/shapes.hpp"

namespace whisker::paths {
namespace {

using sim::Vec2;

constexpr double kSlack = 1e-9;    // m; a line closer by at most this still only touches
constexpr double kFinest = 0.3;    // m
constexpr double kMostCells = 64;  // per side

bool same(const sim::Disc& a, const sim::Disc& b) {
  return a.center.x == b.center.x && a.center.y == b.center.y && a.radius == b.radius;
}

double squared_distance(Vec2 p, const sim::Segment& s) {
  const Vec2 along = s.b - s.a;
  const double length2 = sim::dot(along, along);
  const double t = length2 > 0 ? std::clamp(sim::dot(p - s.a, along) / length2, 0.0, 1.0) : 0.0;
  const Vec2 off = p - (s.a + along * t);
  return sim::dot(off, off);
}

/// Whether the segments cross; touching ends are handled by the rims.
bool cross(const sim::Segment& s, const sim::Segment& t) {
  const Vec2 along = s.b - s.a;
  const double side_a = sim::cross(along, t.a - s.a);
  const double side_b = sim::cross(along, t.b - s.a);
  if ((side_a > 0) == (side_b > 0)) return false;
  const Vec2 other = t.b - t.a;
  return (sim::cross(other, s.a - t.a) > 0) != (sim::cross(other, s.b - t.a) > 0);
}

}  // namespace

Inflated::Inflated(const World& world, Vec2 from, Vec2 to, double radius_m)
    : radius_(radius_m), segments_(world.segments), corner_(from) {
  for (const sim::Disc& d : world.discs) rims_.push_back({d.center, d.radius + radius_m});
  for (const sim::Segment& s : world.segments) {
    rims_.push_back({s.a, radius_m});
    rims_.push_back({s.b, radius_m});
  }
  const auto less = [](const sim::Disc& a, const sim::Disc& b) {
    if (a.center.x != b.center.x) return a.center.x < b.center.x;
    if (a.center.y != b.center.y) return a.center.y < b.center.y;
    return a.radius < b.radius;
  };
  std::sort(rims_.begin(), rims_.end(), less);
  rims_.erase(std::unique(rims_.begin(), rims_.end(), same), rims_.end());
  lay_grid(from, to);
  fill_grid();
}

void Inflated::lay_grid(Vec2 from, Vec2 to) {
  Vec2 high = from;
  const auto cover = [&](Vec2 p, double margin) {
    corner_ = {std::min(corner_.x, p.x - margin), std::min(corner_.y, p.y - margin)};
    high = {std::max(high.x, p.x + margin), std::max(high.y, p.y + margin)};
  };
  cover(from, 0);
  cover(to, 0);
  for (const sim::Disc& rim : rims_) cover(rim.center, rim.radius);
  cell_ = std::max({kFinest, (high.x - corner_.x) / kMostCells, (high.y - corner_.y) / kMostCells});
  columns_ = static_cast<int>((high.x - corner_.x) / cell_) + 1;
  rows_ = static_cast<int>((high.y - corner_.y) / cell_) + 1;
  buckets_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

void Inflated::fill_grid() {
  const auto at = [&](int column, int row) -> Bucket& {
    return buckets_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
  };
  for (std::size_t i = 0; i < rims_.size(); ++i) {
    const Cells cells = around(rims_[i]);
    for (int r = cells.row_min; r <= cells.row_max; ++r) {
      for (int c = cells.column_min; c <= cells.column_max; ++c) {
        const Vec2 low = corner_ + Vec2{c * cell_, r * cell_};
        const Vec2 nearest{std::clamp(rims_[i].center.x, low.x, low.x + cell_),
                           std::clamp(rims_[i].center.y, low.y, low.y + cell_)};
        if (distance(nearest, rims_[i].center) <= rims_[i].radius + kSlack) {
          at(c, r).rims.push_back(static_cast<int>(i));
        }
      }
    }
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const sim::Segment& s = segments_[i];
    const double left = std::min(s.a.x, s.b.x) - radius_;
    const double right = std::max(s.a.x, s.b.x) + radius_;
    for (int c = column(left); c <= column(right); ++c) {
      const Cells cells = along(s, c, radius_);
      for (int r = cells.row_min; r <= cells.row_max; ++r) at(c, r).segments.push_back(static_cast<int>(i));
    }
  }
}

int Inflated::column(double x) const {
  return std::clamp(static_cast<int>((x - corner_.x) / cell_), 0, columns_ - 1);
}

int Inflated::row(double y) const {
  return std::clamp(static_cast<int>((y - corner_.y) / cell_), 0, rows_ - 1);
}

Inflated::Cells Inflated::around(const sim::Disc& disc) const {
  return {column(disc.center.x - disc.radius), column(disc.center.x + disc.radius),
          row(disc.center.y - disc.radius), row(disc.center.y + disc.radius)};
}

/// The cells of one column that the line, widened by this margin, may touch.
Inflated::Cells Inflated::along(const sim::Segment& line, int column, double margin) const {
  const sim::Segment s = line.a.x <= line.b.x ? line : sim::Segment{line.b, line.a};
  const double left = corner_.x + column * cell_ - margin - kSlack;
  const double right = left + cell_ + 2 * (margin + kSlack);
  const double width = s.b.x - s.a.x;
  const auto height_at = [&](double x) {
    if (width <= 0) return x <= s.a.x ? s.a.y : s.b.y;
    return s.a.y + (s.b.y - s.a.y) * std::clamp((x - s.a.x) / width, 0.0, 1.0);
  };
  const double y1 = height_at(left);
  const double y2 = height_at(right);
  return {column, column, row(std::min(y1, y2) - margin - kSlack), row(std::max(y1, y2) + margin + kSlack)};
}

bool Inflated::free(Vec2 point) const {
  const Bucket& here = bucket(column(point.x), row(point.y));
  for (const int i : here.rims) {
    const sim::Disc& rim = rims_[static_cast<std::size_t>(i)];
    const Vec2 off = point - rim.center;
    const double least = rim.radius - kSlack;
    if (sim::dot(off, off) < least * least) return false;
  }
  const double least = radius_ - kSlack;
  return std::all_of(here.segments.begin(), here.segments.end(), [&](int i) {
    return squared_distance(point, segments_[static_cast<std::size_t>(i)]) >= least * least;
  });
}

bool Inflated::crosses_any(const sim::Segment& line, const Bucket& bucket) const {
  for (const int i : bucket.rims) {
    const sim::Disc& rim = rims_[static_cast<std::size_t>(i)];
    const double least = rim.radius - kSlack;
    if (squared_distance(rim.center, line) < least * least) return true;
  }
  return std::any_of(bucket.segments.begin(), bucket.segments.end(),
                     [&](int i) { return cross(line, segments_[static_cast<std::size_t>(i)]); });
}

bool Inflated::free(const sim::Segment& line) const {
  const int first = column(std::min(line.a.x, line.b.x) - kSlack);
  const int last = column(std::max(line.a.x, line.b.x) + kSlack);
  for (int c = first; c <= last; ++c) {
    const Cells cells = along(line, c, 0);
    for (int r = cells.row_min; r <= cells.row_max; ++r) {
      if (crosses_any(line, bucket(c, r))) return false;
    }
  }
  return true;
}

}  // namespace whisker::paths

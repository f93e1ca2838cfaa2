#include "host/lab/report/track.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host/lab/report/axes.hpp"

namespace whisker::report {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using sim::Vec2;

double length(Vec2 v) { return std::hypot(v.x, v.y); }

bool same(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  const double k = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return length(p - (a + along * k));
}

bool placed(const TickRecord& r) { return drawable({r.x_m, r.y_m}); }

/// All points, split where the activity changes.
std::vector<Piece> full_pieces(const std::vector<TickRecord>& records) {
  std::vector<Piece> all;
  bool first = true;
  Vec2 last;
  for (const TickRecord& r : records) {
    if (!placed(r)) continue;
    const Vec2 at{r.x_m, r.y_m};
    if (!first && !same(at, last)) {
      if (all.empty() || all.back().doing != doing(r)) all.push_back({doing(r), {last}});
      all.back().points.push_back(at);
    }
    last = at;
    first = false;
  }
  return all;
}

/// A point too far from the line between two others, or `from`. Among points nearly as far as the farthest it
/// takes the middle one: halving keeps a jagged path of n points at n log n instead of n^2.
std::size_t split_point(const std::vector<Vec2>& points, std::size_t from, std::size_t to,
                        double tolerance_m) {
  const auto distance = [&](std::size_t i) {
    return distance_to_segment(points[i], points[from], points[to]);
  };
  double farthest = tolerance_m;
  std::size_t split = from;
  for (std::size_t i = from + 1; i < to; ++i) {
    if (const double d = distance(i); d > farthest) {
      farthest = d;
      split = i;
    }
  }
  if (split == from) return from;
  const double enough = std::max(0.9 * farthest, tolerance_m);
  const std::size_t middle = from + (to - from) / 2;
  for (std::size_t away = 0; away <= (to - from) / 2; ++away) {
    if (middle + away < to && distance(middle + away) > enough) return middle + away;
    if (middle - away > from && distance(middle - away) > enough) return middle - away;
  }
  return split;
}

}  // namespace

TrackSummary summarise(const std::vector<TickRecord>& records) {
  TrackSummary s;
  const TickRecord* last = nullptr;
  int danger = 0;
  for (const TickRecord& r : records) {
    if (r.looked) ++s.looks;
    if (danger == 0 && r.danger_count > 0) ++s.danger_entries;
    danger = r.danger_count;
    s.longest_danger = std::max(s.longest_danger, danger);
    if (!placed(r)) {
      ++s.without_place;
      continue;
    }
    if (last != nullptr) {
      const double step = std::hypot(r.x_m - last->x_m, r.y_m - last->y_m);
      s.metres[static_cast<std::size_t>(doing(r))] += step;
      s.total_m += step;
    }
    last = &r;
  }
  return s;
}

std::vector<Vec2> simplified(const std::vector<Vec2>& points, double tolerance_m) {
  if (points.size() < 3) return points;
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    const std::size_t split = split_point(points, from, to, tolerance_m);
    if (split == from) continue;
    keep[split] = true;
    open.emplace_back(from, split);
    open.emplace_back(split, to);
  }
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (keep[i]) kept.push_back(points[i]);
  return kept;
}

std::vector<Piece> pieces(const std::vector<TickRecord>& records, double tolerance_m,
                          std::size_t max_points) {
  const std::vector<Piece> full = full_pieces(records);
  std::vector<Piece> kept;
  std::size_t count = 0;
  // A piece needs at least two points; 20 doublings turn half a millimetre into half a kilometre.
  for (int doublings = 0; doublings < 20; ++doublings, tolerance_m *= 2) {
    kept.clear();
    count = 0;
    for (const Piece& piece : full) {
      kept.push_back({piece.doing, simplified(piece.points, tolerance_m)});
      count += kept.back().points.size();
    }
    if (count <= std::max(max_points, 2 * full.size())) break;
  }
  return kept;
}

Vec2 mover_position(const std::vector<Vec2>& path, Vec2 center, double driven_m) {
  if (path.size() < 2) return center;
  std::vector<double> at = {0};
  double start = 0;
  double nearest = kInfinity;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 along = path[i] - path[i - 1];
    const double size = length(along);
    const double d = distance_to_segment(center, path[i - 1], path[i]);
    if (d < nearest) {
      nearest = d;
      const double k = size > 0 ? std::clamp(dot(center - path[i - 1], along) / size, 0.0, size) : 0.0;
      start = at.back() + k;
    }
    at.push_back(at.back() + size);
  }
  const double total = at.back();
  if (!(total > 0)) return center;
  const double lap = std::fmod(start + driven_m, 2 * total);
  const double s = lap <= total ? lap : 2 * total - lap;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double size = at[i] - at[i - 1];
    if (s <= at[i] && size > 0) return path[i - 1] + (path[i] - path[i - 1]) * ((s - at[i - 1]) / size);
  }
  return path.back();
}

}  // namespace whisker::report

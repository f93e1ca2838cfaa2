#include "tests/paths/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "host/harness/scenario/shapes.hpp"

namespace whisker::paths {
namespace {

using sim::Vec2;

constexpr double kCell = 0.03;

struct Grid {
  Vec2 low;
  int width = 0, height = 0;
  std::vector<double> gaps;

  Grid(const World& world, Vec2 from, Vec2 to) : low(from) {
    Vec2 high = from;
    const auto cover = [&](Vec2 p, double r) {
      low = {std::min(low.x, p.x - r - 0.5), std::min(low.y, p.y - r - 0.5)};
      high = {std::max(high.x, p.x + r + 0.5), std::max(high.y, p.y + r + 0.5)};
    };
    cover(from, 0);
    cover(to, 0);
    for (const sim::Disc& d : world.discs) cover(d.center, d.radius);
    for (const sim::Segment& s : world.segments) {
      cover(s.a, 0);
      cover(s.b, 0);
    }
    width = static_cast<int>((high.x - low.x) / kCell) + 1;
    height = static_cast<int>((high.y - low.y) / kCell) + 1;
    for (int i = 0; i < width * height; ++i) gaps.push_back(gap(world, at(i)));
  }
  Vec2 at(int i) const { return low + Vec2{(i % width) * kCell, (i / width) * kCell}; }
  int nearest(Vec2 p) const {
    return static_cast<int>((p.y - low.y) / kCell + 0.5) * width +
           static_cast<int>((p.x - low.x) / kCell + 0.5);
  }
  double gap_at(int i) const { return gaps[static_cast<std::size_t>(i)]; }

  /// Dijkstra with eight neighbours; a step is allowed if the gaps at its ends prove it free.
  std::vector<Vec2> way(int from, int to, double radius) const {
    std::vector<double> best(gaps.size(), std::numeric_limits<double>::infinity());
    std::vector<int> before(gaps.size(), -1);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    best[static_cast<std::size_t>(from)] = 0;
    queue.push({0, from});
    while (!queue.empty()) {
      const auto [cost, here] = queue.top();
      queue.pop();
      if (here == to) break;
      if (cost > best[static_cast<std::size_t>(here)]) continue;
      for (int k = 0; k < 9; ++k) {
        const int x = here % width + k % 3 - 1, y = here / width + k / 3 - 1;
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        const int there = y * width + x;
        const double step = distance(at(here), at(there));
        if (gap_at(here) + gap_at(there) - step < 2 * radius) continue;
        double& known = best[static_cast<std::size_t>(there)];
        if (cost + step >= known) continue;
        known = cost + step;
        before[static_cast<std::size_t>(there)] = here;
        queue.push({known, there});
      }
    }
    std::vector<Vec2> points;
    if (before[static_cast<std::size_t>(to)] < 0 && to != from) return points;
    for (int i = to; i >= 0; i = before[static_cast<std::size_t>(i)]) points.push_back(at(i));
    std::reverse(points.begin(), points.end());
    return points;
  }
};

bool line_free(const World& world, const sim::Segment& line, double radius) {
  for (const sim::Disc& d : world.discs) {
    if (distance(d.center, line) < d.radius + radius) return false;
  }
  for (const sim::Segment& s : world.segments) {
    const double near =
        std::min({distance(s.a, line), distance(s.b, line), distance(line.a, s), distance(line.b, s)});
    if (near < radius || intersect(s, line)) return false;
  }
  return true;
}

/// Removes every point that a free line can skip, the farthest skip first.
std::vector<Vec2> pulled(const World& world, const std::vector<Vec2>& way, double radius) {
  std::vector<Vec2> tight{way.front()};
  for (std::size_t here = 0; here + 1 < way.size();) {
    std::size_t next = way.size() - 1;
    while (next > here + 1 && !line_free(world, {way[here], way[next]}, radius)) --next;
    tight.push_back(way[next]);
    here = next;
  }
  return tight;
}

}  // namespace

double gap(const World& world, Vec2 p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const sim::Disc& d : world.discs) nearest = std::min(nearest, distance(p, d.center) - d.radius);
  for (const sim::Segment& s : world.segments) nearest = std::min(nearest, distance(p, s));
  return nearest;
}

std::optional<double> some_way(const World& world, Vec2 from, Vec2 to, double radius_m) {
  const Grid grid(world, from, to);
  const int first = grid.nearest(from), last = grid.nearest(to);
  if (!line_free(world, {from, grid.at(first)}, radius_m)) return std::nullopt;
  if (!line_free(world, {grid.at(last), to}, radius_m)) return std::nullopt;
  std::vector<Vec2> way = grid.way(first, last, radius_m);
  if (way.empty()) return std::nullopt;
  way.insert(way.begin(), from);
  way.push_back(to);
  way = pulled(world, way, radius_m);
  double length = 0;
  for (std::size_t i = 1; i < way.size(); ++i) length += distance(way[i - 1], way[i]);
  return length;
}

}  // namespace whisker::paths

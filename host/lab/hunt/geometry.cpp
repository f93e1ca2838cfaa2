#include "host/lab/hunt/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace whisker::hunt {
namespace {

using sim::Vec2;

constexpr double kMostCells = 1e6;
constexpr double kMostDistances = 1e8;

Vec2 foot(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = sim::dot(along, along);
  const double share = square > 0 ? std::clamp(sim::dot(p - a, along) / square, 0.0, 1.0) : 0;
  return a + along * share;
}

/// An upward ray crosses the edge.
bool crosses(Vec2 p, Vec2 a, Vec2 b) {
  if ((a.x > p.x) == (b.x > p.x)) return false;
  return a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x) > p.y;
}

class Search {
 public:
  explicit Search(Vec2 from) : from_(from) {}

  void disc(const sim::Disc& disc) {
    const Vec2 way = disc.center - from_;
    const double far = length(way);
    const double gap = far - disc.radius;
    if (gap < best_.distance_m) best_ = {gap, far > 0 ? from_ + way * (gap / far) : from_};
  }

  double edge(Vec2 a, Vec2 b) {
    const Vec2 at = foot(from_, a, b);
    const double gap = length(at - from_);
    if (gap < best_.distance_m) best_ = {gap, at};
    return gap;
  }

  void line(const std::vector<Vec2>& points) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) edge(points[i], points[i + 1]);
  }

  void solid(const std::vector<Vec2>& points) {
    bool inside = false;
    double outline = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 a = points[i], b = points[(i + 1) % points.size()];
      outline = std::min(outline, edge(a, b));
      if (crosses(from_, a, b)) inside = !inside;
    }
    if (inside && -outline < best_.distance_m) best_.distance_m = -outline;
  }

  void bounds(const Bounds& b) {
    const Vec2 corners[] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    double outline = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 4; ++i) outline = std::min(outline, edge(corners[i], corners[(i + 1) % 4]));
    const bool inside = b.min.x < from_.x && from_.x < b.max.x && b.min.y < from_.y && from_.y < b.max.y;
    if (!inside && -outline < best_.distance_m) best_.distance_m = -outline;
  }

  const Near& best() const { return best_; }

 private:
  Vec2 from_;
  Near best_{std::numeric_limits<double>::infinity(), {}};
};

struct Box {
  Vec2 min, max;
  void add(Vec2 p, double margin) {
    min = {std::min(min.x, p.x - margin), std::min(min.y, p.y - margin)};
    max = {std::max(max.x, p.x + margin), std::max(max.y, p.y + margin)};
  }
};

/// Everything, with room to drive around it.
Box surroundings(const Scenario& s, double radius_m) {
  const double room = 4 * radius_m;
  Box box{s.start.at, s.start.at};
  box.add(s.start.at, room);
  box.add(s.goal.at, room);
  for (const sim::Disc& disc : s.discs) box.add(disc.center, disc.radius + room);
  for (const auto* shapes : {&s.walls, &s.polygons}) {
    for (const auto& points : *shapes) {
      for (const Vec2 p : points) box.add(p, room);
    }
  }
  return box;
}

class Flood {
 public:
  Flood(const Scenario& s, double radius_m)
      : scenario_(s), radius_m_(radius_m), box_(surroundings(s, radius_m)), side_m_(radius_m / 6) {
    columns_ = cells(box_.max.x - box_.min.x);
    rows_ = cells(box_.max.y - box_.min.y);
  }

  bool is_cheap() const {
    const double all = static_cast<double>(columns_) * static_cast<double>(rows_);
    return all < kMostCells && all * static_cast<double>(edges()) < kMostDistances;
  }

  /// Whoever stands nearer to an obstacle than the radius may first move away from it by half of that.
  bool reaches_goal() {
    state_.assign(columns_ * rows_, 0);
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column) {
        if (length(place(column, row) - scenario_.start.at) < radius_m_ / 2) visit(column, row);
      }
    }
    while (!open_.empty()) {
      const std::size_t cell = open_.back();
      open_.pop_back();
      const std::size_t column = cell % columns_, row = cell / columns_;
      if (length(place(column, row) - scenario_.goal.at) < scenario_.goal.tolerance_m) return true;
      visit(column - 1, row);
      visit(column + 1, row);
      visit(column, row - 1);
      visit(column, row + 1);
    }
    return false;
  }

 private:
  std::size_t cells(double metres) const { return static_cast<std::size_t>(metres / side_m_) + 1; }
  std::size_t edges() const {
    std::size_t count = scenario_.discs.size() + 4;
    for (const auto* shapes : {&scenario_.walls, &scenario_.polygons}) {
      for (const auto& points : *shapes) count += points.size();
    }
    return count;
  }
  Vec2 place(std::size_t column, std::size_t row) const {
    return {box_.min.x + static_cast<double>(column) * side_m_,
            box_.min.y + static_cast<double>(row) * side_m_};
  }
  void visit(std::size_t column, std::size_t row) {
    if (column >= columns_ || row >= rows_ || state_[row * columns_ + column] != 0) return;
    state_[row * columns_ + column] = 1;
    // Between two free neighbours, the way stays free.
    if (nearest(scenario_, place(column, row)).distance_m > radius_m_ + side_m_ / 2) {
      open_.push_back(row * columns_ + column);
    }
  }

  const Scenario& scenario_;
  double radius_m_;
  Box box_;
  double side_m_;
  std::size_t columns_, rows_;
  std::vector<char> state_;
  std::vector<std::size_t> open_;
};

}  // namespace

double length(Vec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); }

Near nearest(const Scenario& s, Vec2 from) {
  Search search(from);
  for (const sim::Disc& disc : s.discs) search.disc(disc);
  for (const auto& wall : s.walls) search.line(wall);
  for (const auto& polygon : s.polygons) search.solid(polygon);
  if (s.bounds) search.bounds(*s.bounds);
  return search.best();
}

std::size_t count_shapes(const Scenario& s) {
  return s.discs.size() + s.walls.size() + s.polygons.size() + (s.bounds ? 1 : 0);
}

bool has_way(const Scenario& scenario, double radius_m) {
  Flood flood(scenario, radius_m);
  return flood.is_cheap() && flood.reaches_goal();
}

}  // namespace whisker::hunt

#include "host/lab/paths/free_arcs.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/sim/elementary.hpp"

namespace whisker::paths {
namespace {

using sim::Vec2;

constexpr double kSlack = 1e-9;       // rad; the ends of arcs are included
constexpr double kNarrowest = 1e-12;  // rad
constexpr double kSeam = 1.2345;      // rad; the seam avoids the angles of axis-parallel tangents

double angle_of(Vec2 v) { return sim::arc_tangent(v.y, v.x); }

double within_turn(double angle) {
  while (angle < 0) angle += kFullTurn;
  while (angle >= kFullTurn) angle -= kFullTurn;
  return angle;
}

Vec2 at(const sim::Disc& rim, double angle) {
  const sim::SinCos sc = sim::sin_cos(angle);
  return rim.center + Vec2{sc.cos, sc.sin} * rim.radius;
}

/// The angles on one rim at which it may enter or leave another obstacle.
class Crossings {
 public:
  explicit Crossings(const sim::Disc& rim) : rim_(rim) {}

  void with(const sim::Disc& other) {
    const Vec2 between = other.center - rim_.center;
    const double d2 = sim::dot(between, between);
    if (d2 <= 0) return;
    const double along = (d2 + (rim_.radius - other.radius) * (rim_.radius + other.radius)) / (2 * d2);
    const double aside2 = rim_.radius * rim_.radius / d2 - along * along;
    if (aside2 < 0) return;
    const Vec2 aside = Vec2{-between.y, between.x} * std::sqrt(aside2);
    add(between * along + aside);
    add(between * along - aside);
  }

  /// Intersects with the straight sides of the inflated segment.
  void with(const sim::Segment& segment, double radius) {
    const Vec2 way = segment.b - segment.a;
    const double length = std::sqrt(sim::dot(way, way));
    if (length <= 0) return;
    const Vec2 along = way * (1 / length);
    const Vec2 normal{-along.y, along.x};
    for (const double side : {radius, -radius}) {
      const Vec2 start = segment.a + normal * side - rim_.center;
      const double off = sim::dot(start, normal);
      // A side that only touches an end of its own segment has no second root.
      const double half2 = std::fmax(0, rim_.radius * rim_.radius - off * off);
      if (std::fabs(off) > rim_.radius * (1 + kSlack)) continue;
      for (const double half : {std::sqrt(half2), -std::sqrt(half2)}) {
        const double t = half - sim::dot(start, along);
        if (t >= -kSlack && t <= length + kSlack) add(normal * off + along * half);
      }
    }
  }

  std::vector<double> sorted() {
    std::sort(angles_.begin(), angles_.end());
    const auto near = [](double a, double b) { return b - a < kNarrowest; };
    angles_.erase(std::unique(angles_.begin(), angles_.end(), near), angles_.end());
    return std::move(angles_);
  }

 private:
  void add(Vec2 from_center) { angles_.push_back(within_turn(angle_of(from_center))); }

  const sim::Disc& rim_;
  std::vector<double> angles_;
};

}  // namespace

FreeArcs::FreeArcs(const Inflated& inflated, std::size_t index) {
  const sim::Disc& rim = inflated.rims()[index];
  Crossings crossings(rim);
  std::vector<int> rims, segments;
  inflated.each_near(
      rim, [&](int i) { rims.push_back(i); }, [&](int i) { segments.push_back(i); });
  const auto once = [](std::vector<int>& v) {
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
  };
  once(rims);
  once(segments);
  for (const int i : rims) {
    if (static_cast<std::size_t>(i) != index) crossings.with(inflated.rims()[static_cast<std::size_t>(i)]);
  }
  for (const int i : segments) {
    crossings.with(inflated.segments()[static_cast<std::size_t>(i)], inflated.radius());
  }

  std::vector<double> cuts = crossings.sorted();
  if (cuts.empty()) cuts.push_back(kSeam);
  bool all = true;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const double next = i + 1 < cuts.size() ? cuts[i + 1] : cuts.front() + kFullTurn;
    if (!inflated.free(at(rim, (cuts[i] + next) / 2))) {
      all = false;
    } else if (!arcs_.empty() && arcs_.back().from + arcs_.back().length >= cuts[i]) {
      arcs_.back().length = next - arcs_.back().from;
    } else {
      arcs_.push_back({cuts[i], next - cuts[i]});
    }
  }
  if (all) {
    arcs_ = {{kSeam, kFullTurn}};
    whole_ = true;
    return;
  }
  if (arcs_.size() > 1 && arcs_.front().from == cuts.front() &&
      arcs_.back().from + arcs_.back().length >= cuts.front() + kFullTurn) {
    arcs_.back().length += arcs_.front().length;
    arcs_.erase(arcs_.begin());
  }
}

std::optional<FreeArcs::Place> FreeArcs::find(double angle, Side side) const {
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    const Arc& arc = arcs_[i];
    double offset = within_turn(angle - arc.from);
    if (offset > kFullTurn - kSlack && !whole_) offset = 0;
    if (offset > arc.length + kSlack) continue;
    offset = std::min(offset, arc.length);
    return Place{static_cast<int>(i), side == Side::left ? offset : arc.length - offset};
  }
  return std::nullopt;
}

}  // namespace whisker::paths

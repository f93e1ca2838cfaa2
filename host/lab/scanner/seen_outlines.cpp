#include "host/lab/scanner/seen_outlines.hpp"

#include <algorithm>
#include <utility>

#include "host/harness/scenario/shapes.hpp"
#include "host/harness/sim/distance.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::scanner {
namespace {

using sim::Vec2;

constexpr double kEnd = 1e-6;      // m; a span this close to the end of its segment reaches it
constexpr double kInside = 0.002;  // m

void add_polygon(std::vector<sim::Segment>& outlines, const sim::Disc& disc) {
  int corners = 8;
  // The middle of an edge is r (1 - cos(pi / corners)) inside the disc.
  while (disc.radius * (1 - sim::sin_cos(sim::kPi / corners).cos) > kInside) ++corners;
  const auto corner = [&](int i) {
    const sim::SinCos angle = sim::sin_cos(2 * sim::kPi * (i % corners) / corners);
    return disc.center + Vec2{angle.cos, angle.sin} * disc.radius;
  };
  for (int i = 0; i < corners; ++i) outlines.push_back({corner(i), corner(i + 1)});
}

}  // namespace

std::vector<sim::Segment> outlines(const World& world) {
  std::vector<sim::Segment> outlines = world.segments;
  for (const sim::Disc& disc : world.discs) add_polygon(outlines, disc);
  return outlines;
}

SeenOutlines::SeenOutlines(const std::vector<sim::Segment>& outlines)
    : outlines_(outlines), spans_(outlines.size()) {}

void SeenOutlines::add(std::size_t segment, Span span) {
  const double length = distance(outlines_[segment].a, outlines_[segment].b);
  const double end = length > kEnd ? kEnd / length : 1;
  const double near = length > kResolution ? kResolution / length : 1;
  if (span.from < end) span.from = 0;
  if (span.to > 1 - end) span.to = 1;
  std::vector<Span>& spans = spans_[segment];
  const auto first =
      std::find_if(spans.begin(), spans.end(), [&](const Span& s) { return s.to >= span.from - near; });
  const auto last = std::find_if(first, spans.end(), [&](const Span& s) { return s.from > span.to + near; });
  if (first != last) {
    if (last - first == 1 && first->from <= span.from + end && first->to >= span.to - end) return;
    span = {std::min(span.from, first->from), std::max(span.to, (last - 1)->to)};
  }
  spans.insert(spans.erase(first, last), span);
  new_.segments.push_back(piece(segment, span));
}

void SeenOutlines::add_near(Vec2 point, double distance_m) {
  for (std::size_t i = 0; i < outlines_.size(); ++i) {
    const sim::Segment& s = outlines_[i];
    if (sim::distance(point, s) >= distance_m) continue;
    const double length2 = sim::dot(s.b - s.a, s.b - s.a);
    const double at = length2 > 0 ? std::clamp(sim::dot(point - s.a, s.b - s.a) / length2, 0.0, 1.0) : 0;
    add(i, {at, at});
  }
}

World SeenOutlines::known() const {
  World known;
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    for (const Span& span : spans_[i]) known.segments.push_back(piece(i, span));
  }
  return known;
}

World SeenOutlines::take_new() { return std::exchange(new_, {}); }

sim::Segment SeenOutlines::piece(std::size_t segment, Span span) const {
  const sim::Segment& s = outlines_[segment];
  const auto at = [&](double share) { return share == 1 ? s.b : s.a + (s.b - s.a) * share; };
  return {at(span.from), at(span.to)};
}

}  // namespace whisker::scanner

/// What has been seen of a world's outlines: a memory without limit and without error.
#pragma once

#include <cstddef>
#include <vector>

#include "host/scenario/world.hpp"

namespace whisker::scanner {

/// The obstacles as a scanner meets them, of which parts can be seen: discs become polygons whose corners lie
/// on the rim and whose edges lie at most 2 mm inside it. No movers.
std::vector<sim::Segment> outlines(const World& world);

/// Of a segment, the share of its length from its beginning: from 0 to 1.
struct Span {
  double from = 0, to = 0;
};

class Seen {
 public:
  /// Spans of one segment that lie so near are one, m: no scanner tells them apart, and no body fits between.
  static constexpr double kResolution = 0.02;

  /// The outlines must outlive it.
  explicit Seen(const std::vector<sim::Segment>& outlines);

  void add(std::size_t segment, Span span);
  /// The nearest point of each segment that lies nearer to the point than this.
  void add_near(sim::Vec2 point, double distance_m);

  /// The spans seen so far: a part of the world.
  World known() const;
  /// What was added to it since this was asked last.
  World take_new();

 private:
  sim::Segment piece(std::size_t segment, Span span) const;

  const std::vector<sim::Segment>& outlines_;
  std::vector<std::vector<Span>> spans_;  // of each segment, in order, none overlapping
  World new_;
};

}  // namespace whisker::scanner

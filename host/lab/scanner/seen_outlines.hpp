/// The seen parts of a world's outlines: a perfect memory.
#pragma once

#include <cstddef>
#include <vector>

#include "host/harness/scenario/world.hpp"

namespace whisker::scanner {

/// The obstacles as outlines that can be seen in parts: discs become polygons whose corners lie on the rim
/// and whose edges lie at most 2 mm inside it. No movers.
std::vector<sim::Segment> outlines(const World& world);

/// A part of a segment, as shares of its length from its start: 0 to 1.
struct Span {
  double from = 0, to = 0;
};

class SeenOutlines {
 public:
  /// m: spans of one segment this close together are merged; no body fits between them.
  static constexpr double kResolution = 0.02;

  /// The outlines must outlive it.
  explicit SeenOutlines(const std::vector<sim::Segment>& outlines);

  void add(std::size_t segment, Span span);
  /// The nearest point of each segment that is nearer to the point than this.
  void add_near(sim::Vec2 point, double distance_m);

  /// The spans seen so far: a part of the world.
  World known() const;
  /// The segments added since the last call.
  World take_new();

 private:
  sim::Segment piece(std::size_t segment, Span span) const;

  const std::vector<sim::Segment>& outlines_;
  std::vector<std::vector<Span>> spans_;  // of each segment, in order, not overlapping
  World new_;
};

}  // namespace whisker::scanner

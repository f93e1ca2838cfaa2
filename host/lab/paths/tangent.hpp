#pragma once

#include <optional>

#include "host/harness/sim/geometry.hpp"

namespace whisker::paths {

/// Direction of a path around a disc: counter-clockwise with the disc on its left, or clockwise.
enum class Side : int { left = 1, right = -1 };

/// A straight line from one disc to another that touches both. A disc may be a point.
struct Tangent {
  sim::Segment line;
  double length_m = 0;
  sim::Vec2 normal;  ///< of length 1, to the left of the line
};

/// The tangent that leaves disc `a` and arrives at disc `b` in these directions; none if the discs overlap
/// too far, or coincide.
std::optional<Tangent> tangent(const sim::Disc& a, Side side_a, const sim::Disc& b, Side side_b);

/// Where a line with this normal touches the disc.
sim::Vec2 touch(const sim::Disc& disc, Side side, sim::Vec2 normal);

}  // namespace whisker::paths

/// The parts of an inflated obstacle's rim on which the body fits.
#pragma once

#include <optional>
#include <vector>

#include "host/lab/paths/inflated.hpp"
#include "host/lab/paths/tangent.hpp"

namespace whisker::paths {

constexpr double kFullTurn = 0x1.921fb54442d18p+2;

class FreeArcs {
 public:
  FreeArcs(const Inflated& inflated, std::size_t rim);

  bool empty() const { return arcs_.empty(); }
  bool whole() const { return whole_; }  ///< the whole rim is free: one arc with both ends at the same point

  /// A place on an arc: the angle travelled since the start of the arc in this direction.
  struct Place {
    int arc = 0;
    double offset_rad = 0;
  };
  /// The place at this angle, rad in [-10, 10]; none if the body does not fit there.
  std::optional<Place> find(double angle, Side side) const;

 private:
  struct Arc {
    double from, length;  // rad, counter-clockwise
  };
  std::vector<Arc> arcs_;
  bool whole_ = false;
};

}  // namespace whisker::paths

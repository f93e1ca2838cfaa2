/// The obstacles inflated by the radius of the body.
#pragma once

#include <cstddef>
#include <vector>

#include "host/harness/scenario/world.hpp"

namespace whisker::paths {

class Inflated {
 public:
  /// Queried points must lie in the box that contains all obstacles and these two.
  Inflated(const World& world, sim::Vec2 from, sim::Vec2 to, double radius_m);

  double radius() const { return radius_; }
  /// The inflated discs, and one around each end of a segment; all different.
  const std::vector<sim::Disc>& rims() const { return rims_; }
  const std::vector<sim::Segment>& segments() const { return segments_; }

  /// The body fits here.
  bool free(sim::Vec2 point) const;
  /// Between two free points: the body fits on the whole line.
  bool free(const sim::Segment& line) const;

  /// Calls f(rim) and g(segment) for at least everything within this disc, possibly several times.
  template <class F, class G>
  void each_near(const sim::Disc& disc, F&& f, G&& g) const {
    const Cells cells = around(disc);
    for (int row = cells.row_min; row <= cells.row_max; ++row) {
      for (int column = cells.column_min; column <= cells.column_max; ++column) {
        for (const int rim : bucket(column, row).rims) f(rim);
        for (const int segment : bucket(column, row).segments) g(segment);
      }
    }
  }

 private:
  struct Bucket {
    std::vector<int> rims, segments;
  };
  struct Cells {
    int column_min, column_max, row_min, row_max;
  };

  void lay_grid(sim::Vec2 from, sim::Vec2 to);
  void fill_grid();
  int column(double x) const;
  int row(double y) const;
  Cells around(const sim::Disc& disc) const;
  Cells along(const sim::Segment& line, int column, double margin) const;
  const Bucket& bucket(int column, int row) const {
    return buckets_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
  }
  bool crosses_any(const sim::Segment& line, const Bucket& bucket) const;

  double radius_;
  std::vector<sim::Disc> rims_;
  std::vector<sim::Segment> segments_;
  sim::Vec2 corner_;
  double cell_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<Bucket> buckets_;
};

}  // namespace whisker::paths

/// Clear ground on a straight lane through a gap that is hardly wider than the body.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/perception/grid_scale.hpp"
#include "firmware/perception/observation.hpp"
#include "firmware/perception/raster.hpp"

namespace whisker::perception {

/// A strip of 32 x 16 cells whose rows lie along the lane. So the edges of the lane are edges of cells, at
/// whatever angle it crosses the local grid. A cell is clear by the same rule as a cell of the local grid: it
/// lies completely inside an empty beam sector.
class Lane {
 public:
  static constexpr int kRows = 16;

  /// From the middle of the lane to its edge.
  /// `body`: what the body covers between two checked places.
  void configure(Length half_width, Length body) noexcept {
    scale_ = GridScale(half_width.raw() / (kRows / 2));
    body_ = narrow<int16_t>(scale_.units(body));
    open_ = false;
  }
  /// The lane begins here, and leads along this heading. Nothing on it is clear.
  void open(const Pose& from) noexcept;
  void close() noexcept { open_ = false; }
  /// The local grid ages. Clear cells expire one to two spans after they were seen.
  void age() noexcept;
  /// The following are for an open lane.
  bool is_open() const noexcept { return open_; }
  /// As open() was told.
  const Pose& begin() const noexcept { return from_; }
  /// Clears the cells that both observations show empty to these free distances.
  void mark(const Beam& beam, Length free, const EarlierObservation& before, Length free_before) noexcept;
  /// The cells that an echo between these distances may come from are no longer clear.
  void take_back(const Beam& beam, Length begins, Length farthest) noexcept;
  /// Clears the cells completely inside this disc.
  void mark_around(Vec at, Length radius) noexcept;
  /// See LocalGrid::approaches(): true if all ground that counts there lies on the lane and is clear.
  bool holds(const Vec& from, const Vec& way, Length radius) const noexcept;
  /// For display and tests.
  bool is_clear(Vec at) const noexcept;
  Length length() const noexcept { return Length::from_raw(scale_.cell_um() * kCells); }
  Length half_width() const noexcept { return Length::from_raw(scale_.cell_um() * (kRows / 2)); }

 private:
  GridPoint local(Vec at) const noexcept;
  bool is_clear(const Span& span, int row) const noexcept;
  void clear() noexcept;

  GridScale scale_{};
  int16_t body_ = 0;  // grid units
  bool open_ = false;
  bool aged_ = false;
  Pose from_;
  Row clear_[kRows] = {};
};

}  // namespace whisker::perception

/// Clear ground at half the side of the local grid's cells, for gaps hardly wider than the body.
#pragma once

#include <stdint.h>

#include "firmware/perception/grid_frame.hpp"

namespace whisker::perception {

/// A row of fine cells: the left and the right parts of the cells of a row of the local grid.
struct FineRow {
  Row parts[2];
};

/// The window of the local grid in cells of half the side. A fine cell is clear by the same rule as a cell:
/// it lies completely inside an empty beam sector. Where a cell is not clear, some of its parts may be.
///
/// Fine cells have no age: when the cells of the local grid age, those around the body stay, and all others
/// become unknown.
class FineGrid {
 public:
  static constexpr int kParts = 2;  ///< along a side of a cell
  static constexpr int kFineCells = kParts * kCells;

  /// Side of a cell of the local grid; even.
  void configure(int32_t cell_um) noexcept { frame_.cell_um = cell_um / kParts; }
  /// The corner of the local grid's window, in its cells. Whoever moves it forgets what leaves the window.
  void place(int32_t column, int32_t row) noexcept {
    frame_.column = column * kParts;
    frame_.row = row * kParts;
  }
  const GridFrame& frame() const noexcept { return frame_; }

  /// Those of these fine cells of a row that are not clear, as cells of the local grid.
  Row unclear(int row, const Span& touched) const noexcept;
  bool is_clear(GridPoint at) const noexcept;
  void mark(int row, const Span& clear) noexcept;
  /// Cells completely inside this disc are clear.
  void mark_around(GridPoint centre, int32_t radius) noexcept;
  /// All cells with centres outside this disc become unknown.
  void keep_around(GridPoint centre, int32_t radius) noexcept;
  /// The parts of these cells of a row of the local grid become unknown; on the torus.
  void forget(int row, Row cells) noexcept;

 private:
  static FineRow columns(const Span& span) noexcept;
  int slot(int row) const noexcept { return (frame_.row + row) & (kFineCells - 1); }
  uint32_t shift() const noexcept { return static_cast<uint32_t>(frame_.column / kParts) & (kCells - 1); }
  Row to_torus(Row window) const noexcept {
    return shift() == 0 ? window : (window << shift()) | (window >> (kCells - shift()));
  }
  Row to_window(Row torus) const noexcept {
    return shift() == 0 ? torus : (torus >> shift()) | (torus << (kCells - shift()));
  }

  GridFrame frame_;
  FineRow clear_[kFineCells] = {};
};

}  // namespace whisker::perception

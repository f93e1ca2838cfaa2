/// A coarse map of where the body has been: a rolling window of cells.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/global/grid.hpp"

namespace whisker::planning {

/// What is known of a cell. The bits are those of the planes: what is at least `suspect` has the upper one.
enum class CellState : uint8_t {
  unknown,
  free,      ///< a beam saw it empty as a whole
  suspect,   ///< somewhere on an echo's arc
  occupied,  ///< an echo can have come from nowhere else
};

/// Cells are aligned with the world. The map guides and proves nothing: only perception::LocalGrid says where
/// the body may be.
class GridMap {
 public:
  /// `storage`: kPlanes x shape.size() words, which must outlive the map. The last two planes are the plan's.
  GridMap(const GridShape& shape, GridWord* storage) noexcept : shape_(shape), planes_(storage) {}

  void configure(const Params& params) noexcept;
  /// Nothing is known; the window lies around the body, nearer to the goal.
  void reset(Vec body, Vec goal) noexcept;
  /// Moves the window on where the body comes near its border. True: it moved.
  bool follow(Vec body, Vec goal) noexcept;
  /// What one beam shows. `hold`: a plan is being made, and what blocks where it has come to stays so.
  void mark(const perception::ConeObservation& observation, bool hold) noexcept;
  /// What is free by the local grid as good as a whole: beams show it together that do not singly. Not while
  /// a plan is being made.
  void free(const perception::LocalGrid& local_grid, Vec body) noexcept;
  void set(Cell p, CellState state) noexcept;
  CellState at(Cell p) const noexcept;
  /// Of everything that is no free ground, nothing is known.
  void doubt_all() noexcept;

  const GridShape& shape() const noexcept { return shape_; }
  Length cell() const noexcept { return Length::from_raw(cell_um_); }
  /// The window's cell at this place of the world; it may lie outside.
  Cell place(Vec at) const noexcept;
  bool holds(Cell p) const noexcept {
    return p.x >= 0 && p.y >= 0 && p.x < shape_.columns() && p.y < shape_.rows;
  }
  /// The middle of a cell.
  Vec middle(Cell p) const noexcept;
  /// From the world's origin to the window's first cell.
  Cell corner() const noexcept { return corner_; }

  /// The planes, row by row.
  GridWord* blocking() const noexcept { return planes_; }
  GridWord* sure() const noexcept { return plane(1); }
  GridWord* level_high() const noexcept { return plane(2); }
  GridWord* level_low() const noexcept { return plane(3); }

  /// Unseen cells beside what blocks, of the four neighbours: there is no room for the body. None where cells
  /// are as wide as that takes.
  GridWord cramped(int32_t row, int w) const noexcept;

 private:
  struct Box;
  GridWord* plane(int n) const noexcept { return planes_ + ptrdiff_t{n} * shape_.size(); }
  GridWord touched(int32_t row, int w) const noexcept;
  int32_t units(Length l) const noexcept;
  Cell corner_for(Vec body, Vec goal) const noexcept;
  void move_by(Cell step) noexcept;

  GridShape shape_;
  GridWord* planes_;
  Cell corner_;
  int32_t cell_um_ = 100000;
  Length offset_;
  Angle half_cone_;
  int32_t far_ = 0;  // grid units; farther away nothing is marked
};

}  // namespace whisker::planning

/// A coarse map of the beams' observations: a rolling window of cells.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/global/grid.hpp"

namespace whisker::planning {

/// State of a cell, as the bits of the planes: `suspect` and `occupied` have the upper one.
enum class CellState : uint8_t {
  unknown,
  free,      ///< a beam saw it completely empty
  suspect,   ///< somewhere on the arc of an echo
  occupied,  ///< the echo must have come from here
};

/// Cells are aligned with the world. The map guides the robot but proves nothing: only perception::LocalGrid
/// decides where the body may be.
class GridMap {
 public:
  /// `storage`: kPlanes x shape.size() words, which must outlive the map. The plan uses the last two planes.
  GridMap(const GridShape& shape, GridWord* storage) noexcept
      : shape_(shape), planes_(storage), size_(static_cast<int16_t>(shape.size())) {}

  void configure(const Params& params) noexcept;
  /// Resets the map to unknown; the window contains the body and is shifted towards the goal.
  void reset(Vec body, Vec goal) noexcept;
  /// Moves the window if the body comes near its border. True: it moved.
  bool follow(Vec body, Vec goal) noexcept;
  /// A wavefront that is under way.
  struct Hold {
    Cell body;
    Cell goal;
    bool strict = true;  ///< suspect cells block it, too
  };
  /// Adds the observation of one beam. `doubts`: if no other cell explains an echo, free ones do, and a beam
  /// frees no cell of a wall that it meets at an angle. Returns the rows that it looked at.
  ///
  /// While a wavefront is under way, a blocked cell where it has been is only noted to be free: if it opened
  /// behind the wavefront, it would get a level that does not lead to the goal.
  int32_t mark(const perception::ConeObservation& observation, const Hold* hold = nullptr,
               bool doubts = false) noexcept;
  /// The wavefront is over, or given up: frees what has been noted.
  void release(const Hold& hold) noexcept;
  /// Cells of a word that block the wavefront, and have been noted to be free or are its own.
  GridWord noted(int32_t i, bool strict) const noexcept {
    return (level_high()[i] | level_low()[i]) & blocking()[i] & (strict ? ~GridWord{0} : sure()[i]);
  }
  /// Copies mostly clear cells from the local grid, because several beams together clear cells that none
  /// clears alone: those of one row, at most so many above or below the body's. Not while a plan is in
  /// progress.
  void free(const perception::LocalGrid& local_grid, Vec body, int32_t row) noexcept;
  int32_t reach_of(const perception::LocalGrid& local_grid) const noexcept;
  void set(Cell p, CellState state) noexcept;
  CellState at(Cell p) const noexcept;
  /// Resets every cell that is not free to unknown.
  void doubt_all() noexcept;

  const GridShape& shape() const noexcept { return shape_; }
  Length cell() const noexcept { return Length::from_raw(cell_um_); }
  /// The window's cell at this place of the world; it may be outside.
  Cell place(Vec at) const noexcept;
  bool holds(Cell p) const noexcept {
    return p.x >= 0 && p.y >= 0 && p.x < shape_.columns() && p.y < shape_.rows;
  }
  /// A path may leave the window here.
  bool at_rim(Cell p) const noexcept {
    return p.x == 0 || p.y == 0 || p.x == shape_.columns() - 1 || p.y == shape_.rows - 1;
  }
  /// The centre of a cell.
  Vec middle(Cell p) const noexcept;
  /// Offset of the window's first cell from the origin of the world.
  Cell corner() const noexcept { return corner_; }

  /// The planes, row by row.
  GridWord* blocking() const noexcept { return planes_; }
  GridWord* sure() const noexcept { return plane(1); }
  GridWord* level_high() const noexcept { return plane(2); }
  GridWord* level_low() const noexcept { return plane(3); }

 private:
  struct Box;
  GridWord* plane(int n) const noexcept { return planes_ + ptrdiff_t{n} * size_; }
  GridWord touched(int32_t row, int w) const noexcept;
  /// Of these cells of a word, those that must not open yet.
  GridWord held(int32_t row, int w, const Hold& hold, GridWord cells) noexcept;
  static GridWord own(const Hold& hold, int32_t row, int w) noexcept;
  GridWord oblique(int32_t row, int w, bool upright) const noexcept;
  int32_t units(Length l) const noexcept;
  Cell corner_for(Vec body, Vec goal) const noexcept;
  void move_by(Cell step) noexcept;

  GridShape shape_;
  GridWord* planes_;
  Cell corner_;
  int32_t cell_um_ = 100000;
  int32_t far_ = 0;     // grid units; echoes farther away are ignored
  bool notes_ = false;  // release() has something to do
  int16_t size_;        // of a plane
};

}  // namespace whisker::planning

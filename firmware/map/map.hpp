/// A coarse map of where the body has been: a rolling window of cells.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/core/trig.hpp"
#include "firmware/ground/patch.hpp"
#include "firmware/map/grid.hpp"
#include "firmware/params.hpp"

namespace whisker::map {

/// What is known of a cell. The bits are those of the planes: what is at least `suspect` has the upper one.
enum class State : uint8_t {
  unknown,
  free,      ///< a beam saw it empty as a whole
  suspect,   ///< somewhere on an echo's arc
  occupied,  ///< an echo can have come from nowhere else
};

/// Cells are aligned with the world. The map guides and proves nothing: only ground::Patch says where the
/// body may be.
class Map {
 public:
  /// `storage`: kPlanes x shape.size() words, which must outlive the map. The last two planes are the plan's.
  Map(const Shape& shape, Word* storage) noexcept : shape_(shape), planes_(storage) {}

  void configure(const Params& params) noexcept;
  /// Nothing is known; the window lies around the body, nearer to the goal.
  void reset(Vec body, Vec goal) noexcept;
  /// Moves the window on where the body comes near its border. True: it moved.
  bool follow(Vec body, Vec goal) noexcept;
  /// What one beam shows. `hold`: a plan is being made, and what blocks where it has come to stays so.
  void mark(const ground::Proof& proof, bool hold) noexcept;
  /// What is free by the patch as good as a whole: beams show it together that do not singly. Not while a
  /// plan is being made.
  void free(const ground::Patch& patch, Vec body) noexcept;
  void set(Place p, State state) noexcept;
  State at(Place p) const noexcept;
  /// Of everything that is no free ground, nothing is known.
  void doubt_all() noexcept;

  const Shape& shape() const noexcept { return shape_; }
  Length cell() const noexcept { return Length::from_raw(cell_um_); }
  /// The window's cell at this place of the world; it may lie outside.
  Place place(Vec at) const noexcept;
  bool holds(Place p) const noexcept {
    return p.x >= 0 && p.y >= 0 && p.x < shape_.columns() && p.y < shape_.rows;
  }
  /// The middle of a cell.
  Vec middle(Place p) const noexcept;
  /// From the world's origin to the window's first cell.
  Place corner() const noexcept { return corner_; }

  /// The planes, row by row.
  Word* blocking() const noexcept { return planes_; }
  Word* sure() const noexcept { return plane(1); }
  Word* level_high() const noexcept { return plane(2); }
  Word* level_low() const noexcept { return plane(3); }

  /// Unseen cells beside what blocks, of the four neighbours: there is no room for the body. None where cells
  /// are as wide as that takes.
  Word cramped(int32_t row, int w) const noexcept;

 private:
  struct Box;
  Word* plane(int n) const noexcept { return planes_ + ptrdiff_t{n} * shape_.size(); }
  Word touched(int32_t row, int w) const noexcept;
  int32_t units(Length l) const noexcept;
  Place corner_for(Vec body, Vec goal) const noexcept;
  void move_by(Place step) noexcept;

  Shape shape_;
  Word* planes_;
  Place corner_;
  int32_t cell_um_ = 100000;
  Length offset_;
  Angle half_cone_;
  int32_t far_ = 0;  // grid units; farther away nothing is marked
};

}  // namespace whisker::map

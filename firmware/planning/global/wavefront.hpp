/// How far every cell is from the goal, level by level, as if all that is unknown were free.
#pragma once

#include <stdint.h>

#include "firmware/planning/global/grid_map.hpp"

namespace whisker::planning {

/// Levels from the origin to this place in open ground.
int32_t cell_distance(Cell d) noexcept;

/// A step goes to the four neighbours at odd levels and to all eight at even ones, not across the corner of
/// something that blocks: so a level is a cell's side, to 12 %. A goal outside the window comes in over the
/// border.
///
/// Of each cell the plan keeps its level modulo 3. That is exact: four-neighbours differ by one at most.
class Wavefront {
 public:
  struct Task {
    Cell body;                 ///< of the window
    Cell goal;                 ///< the same; it may lie outside
    int32_t most = INT32_MAX;  ///< levels
    bool strict = false;       ///< suspects block, and so do cramped cells
  };

  /// Until it is over, the window may not move, and what blocks may open only where the wavefront has not
  /// come to, as Map::mark holds it.
  void begin(GridMap& map, const Task& task) noexcept;
  /// Goes on for so many words of rows, and up to one row more. True: over.
  bool run(GridMap& map, int32_t words) noexcept;

  bool reached() const noexcept { return reached_ >= 0; }
  /// The body's level.
  int32_t level() const noexcept { return reached_; }
  /// All levels that were used; what it took.
  int32_t levels() const noexcept { return level_; }

  bool blocked(const GridMap& map, Cell p) const noexcept;
  /// 0..2: the level modulo 3; negative: not reached, or outside.
  int phase(const GridMap& map, Cell p) const noexcept;
  /// The next cell on the way from p to the goal, as straight at `aim` as there is one. False: p is the goal,
  /// or where the way leaves the window.
  bool next(const GridMap& map, Cell p, Cell aim, Cell& on) const noexcept;

 private:
  class Rows;
  enum class Entry : uint8_t { goal, facing_border, any_border };
  GridWord passable(const GridMap& map, int32_t row, int w) const noexcept;
  void begin_level(const GridMap& map) noexcept;
  bool end_level(GridMap& map) noexcept;
  bool reaches_border(const GridMap& map) const noexcept;
  int32_t farthest(const GridMap& map) const noexcept;

  Task task_;
  int32_t level_ = 0;  // under way
  int32_t row_ = 0;    // next of this level
  int32_t last_ = -1;  // of this level
  int32_t low_ = 0;    // rows with cells of the level before
  int32_t high_ = -1;
  int32_t new_low_ = 0;  // of this one
  int32_t new_high_ = -1;
  int32_t reached_ = -1;
  int32_t detour_ = 0;  // levels by which the border is farther than it looks
  Entry entry_ = Entry::goal;
  bool over_ = true;
};

}  // namespace whisker::planning

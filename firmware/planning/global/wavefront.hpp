/// Distance of every cell from the goal, level by level, with unknown cells as free.
#pragma once

#include <stdint.h>

#include "firmware/planning/global/grid_map.hpp"

namespace whisker::planning {

/// Levels from the origin to this place without obstacles.
int32_t cell_distance(Cell d) noexcept;

/// A step goes to the four neighbours at odd levels and to all eight at even ones, never across the corner of
/// a blocked cell. So a level equals the side of a cell to within 12 %. For a goal outside the window, the
/// wavefront starts at the border.
///
/// Each cell stores its level modulo 3. That is exact, because the levels of four-neighbours differ by at
/// most one.
class Wavefront {
 public:
  struct Task {
    Cell body;                 ///< in the window
    Cell goal;                 ///< the same; may be outside
    int32_t most = INT32_MAX;  ///< levels
    bool strict = false;       ///< suspect and inflated cells block
  };

  /// Until it is done, the window must not move, and blocked cells may become passable only where the
  /// wavefront has not arrived (see GridMap::mark).
  void begin(GridMap& map, const Task& task) noexcept;
  /// Processes this number of words of rows, and up to one row more. True: done. `spare`: what was left of
  /// them, if positive.
  bool run(GridMap& map, int32_t words, int32_t* spare = nullptr) noexcept;

  bool over() const noexcept { return over_; }
  bool strict() const noexcept { return task_.strict; }
  /// While it runs.
  GridMap::Hold hold() const noexcept { return {task_.body, task_.goal, task_.strict}; }
  const Cell& goal() const noexcept { return task_.goal; }
  bool reached() const noexcept { return reached_ >= 0; }
  /// The level of the body.
  int32_t level() const noexcept { return reached_; }
  /// The region around the goal is shut within the window: the path, if any, leads around outside.
  bool outside() const noexcept { return entry_ == Entry::any_border; }
  /// Number of levels used, a measure of the cost.
  int32_t levels() const noexcept { return level_; }

  bool blocked(const GridMap& map, Cell p) const noexcept;
  /// 0..2: the level modulo 3; negative: not reached, or outside.
  int phase(const GridMap& map, Cell p) const noexcept;
  /// The next cell on the path from p to the goal, preferring the direction of `aim`. False: p is the goal,
  /// or the path leaves the window here.
  bool next(const GridMap& map, Cell p, Cell aim, Cell& on) const noexcept;

 private:
  class Rows;
  enum class Entry : uint8_t { goal, facing_border, any_border };
  static GridWord three(const GridMap& map, const GridWord* plane, Cell p) noexcept;
  GridWord passable(const GridMap& map, int32_t row, int w) const noexcept;
  void begin_level(const GridMap& map) noexcept;
  bool end_level(GridMap& map) noexcept;
  bool reaches_border(const GridMap& map) const noexcept;
  int32_t farthest(const GridMap& map) const noexcept;

  Task task_;
  int32_t level_ = 0;  // current
  int32_t row_ = 0;    // next row of this level
  int32_t last_ = -1;  // last row of this level
  int32_t low_ = 0;    // rows with cells of the previous level
  int32_t high_ = -1;
  int32_t new_low_ = 0;  // the same for the current level
  int32_t new_high_ = -1;
  int32_t reached_ = -1;
  int32_t detour_ = 0;  // additional levels of the border
  Entry entry_ = Entry::goal;
  bool over_ = true;
};

}  // namespace whisker::planning

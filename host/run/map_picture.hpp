/// The map of a planner as pictures want it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/planning/global/grid_map.hpp"
#include "host/run/shown_guide.hpp"

namespace whisker {

/// The window's cells at one moment, in the estimate's world.
struct MapPicture {
  planning::Cell corner;  ///< the first cell, in cells of the world: it begins at corner times cell_m
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  double cell_m = 0;
  std::vector<planning::CellState> cells;  ///< row after row, upwards
  std::vector<planning::Cell>
      way;  ///< the plan's, from the body to the goal or the border; cells of the window

  planning::CellState at(std::int32_t x, std::int32_t y) const {
    return cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(x)];
  }
};

/// While no plan is under way: the plan's way would not be whole.
MapPicture picture_of(const ShownGuide& guide);

/// Takes pictures of the map of a run, one every 100 ms, or a little later while a plan is under way.
class MapWatch {
 public:
  explicit MapWatch(const Params& params);

  /// Once a tick; null: there is no map. True: there is a new picture.
  bool look(const ShownGuide* guide);
  /// Nothing before the first one.
  const std::optional<MapPicture>& last() const { return last_; }

 private:
  std::int32_t every_;  // ticks
  std::int32_t since_;
  std::optional<MapPicture> last_;
};

}  // namespace whisker

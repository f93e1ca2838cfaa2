/// The map of a planner, for pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/planning/global/grid_map.hpp"
#include "host/harness/run/recording_guide.hpp"

namespace whisker {

/// The cells of the window at one time, in the frame of the estimate.
struct MapPicture {
  planning::Cell corner;  ///< the first cell, in world cells: it starts at corner times cell_m
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  double cell_m = 0;
  std::vector<planning::CellState> cells;  ///< row by row, upwards
  std::vector<planning::Cell> way;  ///< planned path from the body to the goal or the border; window cells

  planning::CellState at(std::int32_t x, std::int32_t y) const {
    return cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(x)];
  }
};

/// Only while no plan is in progress, because the path would be incomplete.
MapPicture picture_of(const RecordingGuide& guide);

/// Takes pictures of a run's map every 100 ms, or a little later while a plan is in progress.
class MapWatch {
 public:
  explicit MapWatch(const Params& params);

  /// Call once per tick; null: there is no map. True: there is a new picture.
  bool look(const RecordingGuide* guide);
  /// None before the first picture.
  const std::optional<MapPicture>& last() const { return last_; }

 private:
  std::int32_t every_;  // ticks
  std::int32_t since_;
  std::optional<MapPicture> last_;
};

}  // namespace whisker

/// The map of a planner over time, stored as changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/harness/run/film.hpp"
#include "host/harness/run/map_picture.hpp"

namespace whisker {

/// Pictures as the changes from each to the next, and the window of each: its first cell, in world cells.
struct MapFrames {
  Frames pictures;
  std::vector<std::int64_t> x, y;

  /// The pictures of `more` from this tick on.
  void append(const MapFrames& more, std::size_t from_tick);
};

/// A picture is three bits per cell, in planes one after the other: the two of planning::CellState, the upper
/// one first, and whether the planned path crosses the cell. A plane is the rows of the window in words of 32
/// bits. Cell (x, y) of the world is bit x mod 32 of word x / 32 mod words of row y mod rows. A frame
/// contains the words that changed since the last frame, as exclusive or.
class MapFilm {
 public:
  static constexpr std::size_t kPlanes = 3;

  /// Appends the picture of this tick as changes since the last call. Pictures must come in order, all of one
  /// size.
  void add(std::size_t tick, const MapPicture& picture, MapFrames& frames);

 private:
  std::vector<std::uint32_t> last_;
};

}  // namespace whisker

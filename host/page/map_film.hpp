/// The map of a planner over time, as what changed in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/page/film.hpp"
#include "host/run/map_picture.hpp"

namespace whisker::page {

/// Pictures as what changed from each to the next, and the window of each: its first cell, in cells of the
/// world.
struct MapFrames {
  Frames pictures;
  std::vector<std::int64_t> x, y;

  /// The pictures of `more` from this tick on.
  void append(const MapFrames& more, std::size_t from_tick);
};

/// A picture is three bits a cell, in planes one after the other: the two of planning::CellState, the upper
/// one first, and whether the plan's way goes there. A plane is the window's rows of words of 32 bits. Cell
/// (x, y) of the world is bit x mod 32 of word x / 32 mod words of row y mod rows. A frame says which words
/// changed since the frame before, by exclusive or.
class MapFilm {
 public:
  static constexpr std::size_t kPlanes = 3;

  /// Appends the picture of this tick, as what changed since the last call. Pictures must come in order, and
  /// all of one size.
  void add(std::size_t tick, const MapPicture& picture, MapFrames& frames);

 private:
  std::vector<std::uint32_t> last_;
};

}  // namespace whisker::page

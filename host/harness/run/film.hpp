/// The local grid over time, stored as changes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"

namespace whisker {

/// Pictures as the changes from each to the next.
struct Frames {
  /// Per picture: its tick, and the number of changed words.
  std::vector<std::int64_t> ticks, changes;
  /// Per change: the index of the word, and the bits to invert.
  std::vector<std::int64_t> words, bits;

  /// The next picture; both have `count` words.
  void add(std::size_t tick, const std::uint32_t* now, const std::uint32_t* last, std::size_t count);
  /// Number of pictures before this tick.
  std::ptrdiff_t before(std::size_t tick) const;
  /// The pictures of `more` from this tick on.
  void append(const Frames& more, std::size_t from_tick);
};

/// A picture is the set of clear cells, see for_each_clear_cell. Cell (x, y) of the world is bit x mod 64 of
/// row y mod 64; a row is two words of 32 bits, the low one first. A frame contains the words that changed
/// since the last frame, as exclusive or.
class Film {
 public:
  static constexpr std::size_t kSide = 64;

  explicit Film(const Params& params);

  /// Appends the picture of this tick as changes since the last call. Pictures must come in order.
  void add(std::size_t tick, Vec body, const perception::LocalGrid& local_grid, Frames& frames);

 private:
  using Picture = std::array<std::uint32_t, kSide * 2>;
  Picture picture(Vec body, const perception::LocalGrid& local_grid) const;

  Params params_;
  Picture last_{};
};

}  // namespace whisker

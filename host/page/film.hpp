/// The local grid over time, as what changed in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"

namespace whisker::page {

/// Pictures as what changed from each to the next.
struct Frames {
  /// A picture each: its tick, and how many words changed.
  std::vector<std::int64_t> ticks, changes;
  /// A change each: which word of the picture, and the bits to turn over.
  std::vector<std::int64_t> words, bits;

  /// The next picture; both have `count` words.
  void add(std::size_t tick, const std::uint32_t* now, const std::uint32_t* last, std::size_t count);
  /// How many pictures come before this tick.
  std::ptrdiff_t before(std::size_t tick) const;
  /// The pictures of `more` from this tick on.
  void append(const Frames& more, std::size_t from_tick);
};

/// A picture is the set of clear cells, see for_each_clear_cell. Cell (x, y) of the world is bit x mod 64 of
/// row y mod 64; a row is two words of 32 bits, the low one first. A frame says which words changed since the
/// frame before, by exclusive or.
class Film {
 public:
  static constexpr std::size_t kSide = 64;

  explicit Film(const Params& params);

  /// Appends the picture of this tick, as what changed since the last call. Pictures must come in order.
  void add(std::size_t tick, Vec body, const perception::LocalGrid& local_grid, Frames& frames);

 private:
  using Picture = std::array<std::uint32_t, kSide * 2>;
  Picture picture(Vec body, const perception::LocalGrid& local_grid) const;

  Params params_;
  Picture last_{};
};

}  // namespace whisker::page

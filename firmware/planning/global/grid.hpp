/// Cells of the map and of the plan: bit planes with a few words per row.
#pragma once

#include <stdint.h>

#include "firmware/math/units.hpp"
#include "firmware/perception/raster.hpp"

namespace whisker::planning {

using GridWord = perception::Row;
constexpr int kWordBits = perception::kCells;
constexpr int kMostWords = 6;

/// A window of words x 32 columns and this number of rows.
struct GridShape {
  int16_t words = 0;
  int16_t rows = 0;
  Length cell{};  ///< side of a cell, for the reference body

  constexpr int32_t columns() const noexcept { return words * kWordBits; }
  constexpr int32_t size() const noexcept { return int32_t{words} * rows; }
};

/// Two bits hold the state of a cell, two its level in the plan.
constexpr int kGridPlanes = 4;

/// A cell by column and row, in the world or in the window.
struct Cell {
  int32_t x = 0;
  int32_t y = 0;
  friend constexpr Cell operator+(Cell a, Cell b) noexcept { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Cell operator-(Cell a, Cell b) noexcept { return {a.x - b.x, a.y - b.y}; }
  friend constexpr bool operator==(Cell a, Cell b) noexcept { return a.x == b.x && a.y == b.y; }
  friend constexpr bool operator!=(Cell a, Cell b) noexcept { return !(a == b); }
};

/// The columns first..last as bits of the word `w`; both may lie outside the window.
constexpr GridWord columns(int32_t first, int32_t last, int w) noexcept {
  const int32_t low = first - w * kWordBits;
  const int32_t high = last - w * kWordBits;
  if (low >= kWordBits || high < 0) return 0;
  return perception::columns_between(static_cast<int>(low < 0 ? 0 : low),
                                     static_cast<int>(high < kWordBits ? high : kWordBits - 1));
}

/// Neighbours of the cells of the middle one of three words.
constexpr GridWord beside(GridWord left, GridWord middle, GridWord right) noexcept {
  return middle << 1 | left >> (kWordBits - 1) | middle >> 1 | right << (kWordBits - 1);
}

}  // namespace whisker::planning

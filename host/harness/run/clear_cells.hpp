#pragma once

#include <cstdint>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"

namespace whisker {

/// The local grid lies within this number of cells from the body's own cell in x and in y.
constexpr std::int64_t kGridReach = 20;

/// Calls use(x, y) for every clear cell, row by row upwards. Cells are indexed in the world: the body's own
/// is floor(estimate / cell) in x and in y.
template <class F>
void for_each_clear_cell(const perception::LocalGrid& local_grid, const Params& params, Vec body,
                         const F& use) {
  const std::int64_t size = grid_cell(params).raw();
  const auto cell_of = [size](Length x) {
    return x.raw() >= 0 ? x.raw() / size : -((size - 1 - x.raw()) / size);
  };
  const auto centre = [size](std::int64_t cell) {
    return Length::from_raw(static_cast<std::int32_t>(cell * size + size / 2));
  };
  const std::int64_t middle_x = cell_of(body.x), middle_y = cell_of(body.y);
  for (std::int64_t y = middle_y - kGridReach; y <= middle_y + kGridReach; ++y) {
    for (std::int64_t x = middle_x - kGridReach; x <= middle_x + kGridReach; ++x) {
      if (local_grid.is_clear({centre(x), centre(y)})) use(x, y);
    }
  }
}

}  // namespace whisker

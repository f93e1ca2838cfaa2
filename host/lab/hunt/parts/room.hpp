/// A map of the planner with storage for its cells.
#pragma once

#include <cstddef>
#include <vector>

#include "firmware/params.hpp"
#include "firmware/planning/global/grid_map.hpp"
#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

struct Room {
  Room(const planning::GridShape& shape, Vec body, Vec goal)
      : storage(static_cast<std::size_t>(planning::kGridPlanes * shape.size())), map(shape, storage.data()) {
    map.configure(params);
    map.reset(body, goal);
  }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  /// Each cell blocks with this chance, half of them surely, or is free with another one.
  void scatter(Dice& dice, double blocked, double free) {
    each([&](planning::Cell p) {
      const double d = dice.uniform(0, 1);
      using planning::CellState;
      if (d < blocked) return map.set(p, d < blocked / 2 ? CellState::occupied : CellState::suspect);
      if (d < blocked + free) map.set(p, CellState::free);
    });
  }
  template <class F>
  void each(const F& f) const {
    for (int y = 0; y < map.shape().rows; ++y) {
      for (int x = 0; x < map.shape().columns(); ++x) f(planning::Cell{x, y});
    }
  }
  std::size_t index(planning::Cell p) const {
    return static_cast<std::size_t>(p.y * map.shape().columns() + p.x);
  }
  bool blocks(planning::Cell p) const { return map.holds(p) && map.at(p) >= planning::CellState::suspect; }

  Params params;
  std::vector<planning::GridWord> storage;
  planning::GridMap map;
};

inline planning::GridShape draw_shape(Dice& dice) {
  const auto words = static_cast<std::int16_t>(1 + dice.index(4));
  const auto rows = static_cast<std::int16_t>(20 + dice.index(50));
  const Length cells[] = {125_mm, 100_mm, 80_mm};
  return {words, rows, cells[dice.index(3)]};
}

inline planning::Cell draw_cell(Dice& dice, const planning::GridShape& shape, int beyond = 0) {
  return {dice.index(shape.columns() + 2 * beyond) - beyond, dice.index(shape.rows + 2 * beyond) - beyond};
}

}  // namespace whisker::hunt

/// A map with storage for its cells, and random maps.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "firmware/params.hpp"
#include "firmware/planning/global/grid_map.hpp"

namespace whisker::test {

struct Room {
  explicit Room(const planning::GridShape& shape, Vec body = {}, Vec goal = {})
      : storage(static_cast<std::size_t>(planning::kGridPlanes * shape.size())), map(shape, storage.data()) {
    map.configure(params);
    map.reset(body, goal);
  }
  /// Every cell blocks with this chance, half of them surely.
  void scatter(std::mt19937& random, double chance) {
    std::uniform_real_distribution<double> draw(0, 1);
    for (int y = 0; y < map.shape().rows; ++y) {
      for (int x = 0; x < map.shape().columns(); ++x) {
        const double d = draw(random);
        if (d < chance)
          map.set({x, y}, d < chance / 2 ? planning::CellState::occupied : planning::CellState::suspect);
      }
    }
  }

  Params params;
  std::vector<planning::GridWord> storage;
  planning::GridMap map;
};

}  // namespace whisker::test

/// A map with room for its cells, and random ones.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "firmware/map/map.hpp"
#include "firmware/params.hpp"

namespace whisker::test {

struct Room {
  explicit Room(const map::Shape& shape, Vec body = {}, Vec goal = {})
      : storage(static_cast<std::size_t>(map::kPlanes * shape.size())), map(shape, storage.data()) {
    map.configure(params);
    map.reset(body, goal);
  }
  /// Every cell blocks with this chance, half of those for sure.
  void scatter(std::mt19937& random, double chance) {
    std::uniform_real_distribution<double> draw(0, 1);
    for (int y = 0; y < map.shape().rows; ++y) {
      for (int x = 0; x < map.shape().columns(); ++x) {
        const double d = draw(random);
        if (d < chance) map.set({x, y}, d < chance / 2 ? map::State::occupied : map::State::suspect);
      }
    }
  }

  Params params;
  std::vector<map::Word> storage;
  map::Map map;
};

/// Cell by cell: in a fine map, an unseen one beside what blocks.
inline bool cramped(const map::Map& map, map::Place p) {
  if (map.shape().cell >= millimetres(75) || map.at(p) != map::State::unknown) return false;
  for (const map::Place d : {map::Place{1, 0}, map::Place{-1, 0}, map::Place{0, 1}, map::Place{0, -1}}) {
    const map::Place q = p + d;
    if (map.holds(q) && map.at(q) >= map::State::suspect) return true;
  }
  return false;
}

}  // namespace whisker::test

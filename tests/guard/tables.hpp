/// Response tables that no rules give.
#pragma once

#include <cstdint>

#include "firmware/fuzzy/bilinear.hpp"
#include "host/harness/worlds/random.hpp"

namespace whisker::test {

using ResponseTable = fuzzy::Bilinear::Table;

inline ResponseTable constant(Q14 turn, Q14 step) {
  ResponseTable table;
  for (auto& row : table.node) {
    for (auto& node : row) node = {turn.raw(), step.raw()};
  }
  return table;
}

inline ResponseTable random_table(worlds::Random& random) {
  ResponseTable table;
  for (auto& row : table.node) {
    for (auto& node : row) {
      node.turn = static_cast<std::int16_t>(random.bits());
      node.step = static_cast<std::int16_t>(random.bits());
    }
  }
  return table;
}

}  // namespace whisker::test

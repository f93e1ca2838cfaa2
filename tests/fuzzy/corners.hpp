/// The values at the corners of the cell that an engine reports.
#pragma once

#include <algorithm>
#include <array>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/fuzzy/variables.hpp"

namespace whisker::fuzzy {

struct Corners {
  std::array<int, 4> turn;
  std::array<int, 4> step;
};

inline Corners corners(const Bilinear::Table& table, Cell cell) {
  Corners c{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Bilinear::Node& node = table.node[cell.distance + i / 2][cell.bias + i % 2];
    c.turn[i] = node.turn;
    c.step[i] = node.step;
  }
  return c;
}

inline Corners corners(const RuleBase& rules, Cell cell) {
  Corners c{};
  for (std::size_t i = 0; i < 4; ++i) {
    c.turn[i] = rules.turn[cell.distance + i / 2][cell.bias + i % 2].raw();
    c.step[i] = rules.step[cell.distance + i / 2][cell.bias + i % 2].raw();
  }
  return c;
}

inline int spread(const std::array<int, 4>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

inline bool within(int value, const std::array<int, 4>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low <= value && value <= *high;
}

inline bool within(const Response& response, const Corners& c) {
  return within(response.turn.raw(), c.turn) && within(response.step.raw(), c.step);
}

}  // namespace whisker::fuzzy

/// A number that names a response table.
#pragma once

#include "firmware/fuzzy/variables.hpp"
#include "firmware/math/crc32.hpp"

namespace whisker::fuzzy {

constexpr void add_answer(Crc32& crc, int16_t raw) noexcept {
  crc.add(static_cast<uint8_t>(static_cast<uint16_t>(raw) & 0xFFU));
  crc.add(static_cast<uint8_t>(static_cast<uint16_t>(raw) >> 8));
}

/// CRC-32 over turn and step of each node, R within D, little-endian.
template <class Table>
constexpr uint32_t digest(const Table& table) noexcept {
  Crc32 crc;
  for (const auto& row : table.node) {
    for (const auto& node : row) {
      add_answer(crc, node.turn);
      add_answer(crc, node.step);
    }
  }
  return crc.value();
}
/// The same over the 25 rules.
constexpr uint32_t digest(const RuleBase& rules) noexcept {
  Crc32 crc;
  for (int d = 0; d < kTerms; ++d) {
    for (int r = 0; r < kTerms; ++r) {
      add_answer(crc, rules.turn[d][r].raw());
      add_answer(crc, rules.step[d][r].raw());
    }
  }
  return crc.value();
}

}  // namespace whisker::fuzzy

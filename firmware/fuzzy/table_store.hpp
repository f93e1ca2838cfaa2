/// Keeps the choice of a response table in a storage, so that a loss of power at any instant leaves the old
/// choice or the new one.
///
/// | bytes | content |
/// |---|---|
/// | 0 | version of the layout: kTableVersion |
/// | 1 | 1: a table; 0: the built-in one, and no nodes follow |
/// | 2, 3 | sequence number: the record with the later number, modulo 2^16, is the newer |
/// | 4, 5 | nodes in D, nodes in R |
/// | 6, 7 | size of the record |
/// | from 8 | turn and step of each node, R within D, 16 bits each |
/// | last 4 | CRC-32 of all bytes before |
///
/// All numbers have their low byte first.
#pragma once

#include <stdint.h>

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/storage/slots.hpp"

namespace whisker::fuzzy {

using storage::Stored;

constexpr uint8_t kTableVersion = 1;
constexpr uint16_t kTableNodes = Bilinear::kDistanceNodes * Bilinear::kBiasNodes;
/// Of a record with a table, and of one with the choice of the built-in table.
constexpr uint16_t kTableRecordBytes = 8 + 4 * kTableNodes + 4;
constexpr uint16_t kBuiltInRecordBytes = 8 + 4;

/// The node of this number, R within D; i < kTableNodes.
constexpr Bilinear::Node& node_of(Bilinear::Table& table, uint16_t i) noexcept {
  return table.node[i / Bilinear::kBiasNodes][i % Bilinear::kBiasNodes];
}
constexpr const Bilinear::Node& node_of(const Bilinear::Table& table, uint16_t i) noexcept {
  return table.node[i / Bilinear::kBiasNodes][i % Bilinear::kBiasNodes];
}

class TableStore {
 public:
  /// Must outlive it. With slots smaller than kTableRecordBytes, no table can be saved.
  explicit TableStore(hal::Storage& storage) noexcept : storage_(storage) {}

  /// The newest undamaged choice. has_table: it is `table`; otherwise it is the built-in one. Unless ok and
  /// has_table, `table` may have any content.
  Stored load(Bilinear::Table& table, bool& has_table) noexcept;
  /// Writes into the slot that has not the newest choice, and reads it back. Blocks as
  /// hal::Storage::erase(). table: null for the built-in one.
  Stored save(const Bilinear::Table* table) noexcept;

 private:
  storage::Content judge(uint8_t slot, uint16_t& sequence) noexcept;
  bool read(uint8_t slot, uint16_t word, uint32_t& value) noexcept;
  bool write(uint8_t slot, uint16_t word, uint32_t value) noexcept;
  template <class Use>
  bool for_each_word(uint16_t sequence, const Bilinear::Table* table, const Use& use) noexcept;

  hal::Storage& storage_;
};

}  // namespace whisker::fuzzy

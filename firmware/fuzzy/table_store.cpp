#include "firmware/fuzzy/table_store.hpp"

#include "firmware/math/fixed.hpp"
#include "firmware/storage/words.hpp"

namespace whisker::fuzzy {
namespace {

using storage::add_word;
using storage::byte_of;
using storage::Content;

constexpr uint16_t kHeaderWords = 2;

constexpr uint32_t word_of(uint8_t b0, uint8_t b1, uint16_t high) noexcept {
  return b0 | uint32_t{b1} << 8 | uint32_t{high} << 16;
}

constexpr uint32_t shape(uint16_t bytes) noexcept {
  return word_of(Bilinear::kDistanceNodes, Bilinear::kBiasNodes, bytes);
}

constexpr uint32_t word_of(const Bilinear::Node& node) noexcept {
  return static_cast<uint16_t>(node.turn) | static_cast<uint32_t>(static_cast<uint16_t>(node.step)) << 16;
}

int16_t half_of(uint32_t word, int shift) noexcept {
  return static_cast<int16_t>(as_signed(word >> shift << 16) / 65536);
}

}  // namespace

bool TableStore::read(uint8_t slot, uint16_t word, uint32_t& value) noexcept {
  return storage::read_word(storage_, slot, word, value);
}

bool TableStore::write(uint8_t slot, uint16_t word, uint32_t value) noexcept {
  uint8_t bytes[4];
  storage::put_word(bytes, value);
  return storage_.write(slot, static_cast<uint16_t>(4 * word), bytes, sizeof bytes);
}

Content TableStore::judge(uint8_t slot, uint16_t& sequence) noexcept {
  uint32_t first = 0, second = 0;
  if (!read(slot, 0, first) || !read(slot, 1, second)) return Content::no_answer;
  const auto bytes = static_cast<uint16_t>(second >> 16);
  if (bytes < kBuiltInRecordBytes || bytes > storage_.size() || bytes % 4 != 0) return Content::damaged;
  const auto last = static_cast<uint16_t>(bytes / 4 - 1);
  Crc32 crc;
  uint32_t word = 0;
  for (uint16_t i = 0; i < last; ++i) {
    if (!read(slot, i, word)) return Content::no_answer;
    add_word(crc, word);
  }
  if (!read(slot, last, word)) return Content::no_answer;
  if (word != crc.value()) return Content::damaged;
  const bool has_table = byte_of(first, 1) == 1;
  const uint16_t right = has_table ? kTableRecordBytes : kBuiltInRecordBytes;
  if (byte_of(first, 0) != kTableVersion || byte_of(first, 1) > 1 || second != shape(right)) {
    return Content::other_version;
  }
  sequence = static_cast<uint16_t>(first >> 16);
  return Content::record;
}

Stored TableStore::load(Bilinear::Table& table, bool& has_table) noexcept {
  const storage::Newest newest =
      storage::newest([this](uint8_t slot, uint16_t& sequence) { return judge(slot, sequence); });
  if (newest.found != Stored::ok) return newest.found;
  uint32_t word = 0;
  if (!read(newest.slot, 0, word)) return Stored::no_answer;
  has_table = byte_of(word, 1) == 1;
  for (uint16_t i = 0; has_table && i < kTableNodes; ++i) {
    if (!read(newest.slot, static_cast<uint16_t>(kHeaderWords + i), word)) return Stored::no_answer;
    node_of(table, i) = {half_of(word, 0), half_of(word, 16)};
  }
  return Stored::ok;
}

template <class Use>
bool TableStore::for_each_word(uint16_t sequence, const Bilinear::Table* table, const Use& use) noexcept {
  Crc32 crc;
  uint16_t at = 0;
  const auto next = [&](uint32_t word) {
    add_word(crc, word);
    return use(at++, word);
  };
  const uint16_t bytes = table != nullptr ? kTableRecordBytes : kBuiltInRecordBytes;
  if (!next(word_of(kTableVersion, table != nullptr ? 1 : 0, sequence)) || !next(shape(bytes))) return false;
  for (uint16_t i = 0; table != nullptr && i < kTableNodes; ++i) {
    if (!next(word_of(node_of(*table, i)))) return false;
  }
  return use(at, crc.value());
}

Stored TableStore::save(const Bilinear::Table* table) noexcept {
  const storage::Newest old =
      storage::newest([this](uint8_t slot, uint16_t& sequence) { return judge(slot, sequence); });
  if (old.found == Stored::no_answer) return Stored::no_answer;
  const uint8_t slot = old.other();
  const auto sequence = static_cast<uint16_t>(old.sequence + 1);
  const bool fits = table == nullptr || storage_.size() >= kTableRecordBytes;
  const bool written =
      fits && storage_.erase(slot) &&
      for_each_word(sequence, table, [&](uint16_t i, uint32_t word) { return write(slot, i, word); }) &&
      for_each_word(sequence, table, [&](uint16_t i, uint32_t word) {
        uint32_t back = 0;
        return read(slot, i, back) && back == word;
      });
  return written ? Stored::ok : Stored::not_written;
}

}  // namespace whisker::fuzzy

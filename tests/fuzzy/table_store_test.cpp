#include "firmware/fuzzy/table_store.hpp"

#include <array>
#include <cstring>

#include <gtest/gtest.h>

#include "firmware/math/crc32.hpp"
#include "tests/calibration/memory_storage.hpp"

namespace whisker::fuzzy {
namespace {

using Table = Bilinear::Table;

Table numbered(int n) {
  Table table{};
  for (std::uint16_t i = 0; i < kTableNodes; ++i) {
    node_of(table, i) = {static_cast<std::int16_t>(n * 1000 + i), static_cast<std::int16_t>(-n * 1000 - i)};
  }
  return table;
}

bool same(const Table& a, const Table& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

enum class Chosen { built_in, table };

struct Loaded {
  Stored stored = Stored::nothing;
  Chosen chosen = Chosen::built_in;
  Table table{};
};

Loaded load(test::MemoryStorage& storage) {
  Loaded loaded;
  bool has_table = false;
  loaded.stored = TableStore(storage).load(loaded.table, has_table);
  loaded.chosen = has_table ? Chosen::table : Chosen::built_in;
  return loaded;
}

class StoredTable : public testing::Test {
 protected:
  test::MemoryStorage storage_{kTableRecordBytes};
  TableStore store_{storage_};

  Stored save(const Table& table) { return store_.save(&table); }
  void expect(const Table& table) {
    const Loaded loaded = load(storage_);
    ASSERT_EQ(loaded.stored, Stored::ok);
    ASSERT_EQ(loaded.chosen, Chosen::table);
    ASSERT_TRUE(same(loaded.table, table));
  }
};

TEST_F(StoredTable, AnEmptyStorageHasNothingAndKeepsWhatItIsGiven) {
  EXPECT_EQ(load(storage_).stored, Stored::nothing);
  ASSERT_EQ(save(numbered(1)), Stored::ok);
  expect(numbered(1));
  ASSERT_EQ(store_.save(nullptr), Stored::ok);
  EXPECT_EQ(load(storage_).stored, Stored::ok);
  EXPECT_EQ(load(storage_).chosen, Chosen::built_in);
  ASSERT_EQ(save(numbered(2)), Stored::ok);
  expect(numbered(2));
}

// The bytes are a format: the next release reads them.
TEST_F(StoredTable, BytesStayTheSame) {
  ASSERT_EQ(store_.save(nullptr), Stored::ok);
  const auto& slot = storage_.slots[0];
  const std::array<std::uint8_t, 8> head{1, 0, 1, 0, 33, 57, 12, 0};
  EXPECT_TRUE(std::equal(head.begin(), head.end(), slot.begin()));
  Crc32 crc;
  for (const std::uint8_t byte : head) crc.add(byte);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(slot[8 + i], static_cast<std::uint8_t>(crc.value() >> (8 * i)));
  Table table = numbered(0);
  node_of(table, 0) = {0x0102, -2};
  ASSERT_EQ(save(table), Stored::ok);
  const std::array<std::uint8_t, 12> begin{1, 1, 2, 0, 33, 57, 0x70, 0x1D, 0x02, 0x01, 0xFE, 0xFF};
  EXPECT_TRUE(std::equal(begin.begin(), begin.end(), storage_.slots[1].begin()));
  EXPECT_EQ(kTableRecordBytes, 7536);
}

TEST_F(StoredTable, TheNewestIsLoadedAlsoAfterTheSequenceWraps) {
  for (int i = 0; i < 66000; ++i) ASSERT_EQ(store_.save(nullptr), Stored::ok);
  ASSERT_EQ(save(numbered(1)), Stored::ok);
  expect(numbered(1));
  ASSERT_EQ(store_.save(nullptr), Stored::ok);
  EXPECT_EQ(load(storage_).chosen, Chosen::built_in);
}

TEST_F(StoredTable, PowerThatFailsAtAnyByteLeavesTheOldOrTheNewOne) {
  ASSERT_EQ(save(numbered(1)), Stored::ok);
  ASSERT_EQ(save(numbered(2)), Stored::ok);
  const auto before = storage_.slots;
  for (const bool erases : {true, false}) {
    storage_.erases = erases;
    for (int bytes = 0; bytes <= kTableRecordBytes; bytes += erases ? 1 : 8) {
      storage_.slots = before;
      storage_.power = bytes;
      const Stored saved = save(numbered(3));
      storage_.power = -1;
      ASSERT_EQ(saved == Stored::ok, bytes == kTableRecordBytes) << bytes;
      expect(numbered(saved == Stored::ok ? 3 : 2));
    }
  }
}

TEST_F(StoredTable, PowerThatFailsWhileASlotIsErasedLeavesTheOldOne) {
  ASSERT_EQ(save(numbered(1)), Stored::ok);
  ASSERT_EQ(save(numbered(2)), Stored::ok);
  for (int bytes = 0; bytes < kTableRecordBytes; ++bytes) {
    storage_.erase_power = bytes;
    ASSERT_EQ(save(numbered(3)), Stored::not_written);
    storage_.erase_power = -1;
    expect(numbered(2));
  }
  ASSERT_EQ(save(numbered(3)), Stored::ok);
  expect(numbered(3));
}

// From the built-in table to another one and back.
TEST_F(StoredTable, PowerThatFailsBetweenTheBuiltInTableAndAnotherLeavesEither) {
  for (int bytes = 0; bytes <= kBuiltInRecordBytes; ++bytes) {
    ASSERT_EQ(save(numbered(1)), Stored::ok);
    storage_.power = bytes;
    const Stored saved = store_.save(nullptr);
    storage_.power = -1;
    ASSERT_EQ(saved == Stored::ok, bytes == kBuiltInRecordBytes);
    if (saved != Stored::ok) expect(numbered(1));
  }
  EXPECT_EQ(load(storage_).chosen, Chosen::built_in);
}

TEST_F(StoredTable, AWrongBitInTheNewestRecordLeavesTheOneBefore) {
  ASSERT_EQ(save(numbered(1)), Stored::ok);
  ASSERT_EQ(save(numbered(2)), Stored::ok);
  for (std::size_t byte = 0; byte < kTableRecordBytes; ++byte) {
    auto& wrong = storage_.slots[1][byte];
    wrong ^= static_cast<std::uint8_t>(1U << byte % 8);
    expect(numbered(1));
    wrong ^= static_cast<std::uint8_t>(1U << byte % 8);
  }
  expect(numbered(2));
}

TEST_F(StoredTable, ErasedMemoryIsNoRecord) {
  for (int filled = 0; filled < 256; ++filled) {
    for (auto& slot : storage_.slots) slot.assign(slot.size(), static_cast<std::uint8_t>(filled));
    EXPECT_EQ(load(storage_).stored, Stored::nothing) << filled;
  }
}

TEST_F(StoredTable, ARecordOfAnotherLayoutIsNotUsedAndNamed) {
  const auto seal = [&](std::size_t size) {
    Crc32 crc;
    auto& slot = storage_.slots[0];
    for (std::size_t i = 0; i < size - 4; ++i) crc.add(slot[i]);
    for (std::size_t i = 0; i < 4; ++i)
      slot[size - 4 + i] = static_cast<std::uint8_t>(crc.value() >> (8 * i));
  };
  const struct {
    std::size_t byte;
    std::uint8_t value;
  } others[] = {{0, 2}, {1, 2}, {4, 34}, {5, 56}};
  for (const auto& other : others) {
    storage_ = test::MemoryStorage(kTableRecordBytes);
    ASSERT_EQ(save(numbered(1)), Stored::ok);
    storage_.slots[0][other.byte] = other.value;
    seal(kTableRecordBytes);
    EXPECT_EQ(load(storage_).stored, Stored::other_version) << other.byte;
    const auto kept = storage_.slots[0];
    ASSERT_EQ(save(numbered(2)), Stored::ok);
    EXPECT_EQ(storage_.slots[0], kept) << "the other firmware finds its own again";
    expect(numbered(2));
  }
}

TEST_F(StoredTable, FailuresHaveNamesAndChangeNothing) {
  ASSERT_EQ(save(numbered(1)), Stored::ok);
  storage_.refuses = true;
  EXPECT_EQ(save(numbered(2)), Stored::not_written);
  storage_.refuses = false;
  storage_.keeps = 0xFE;
  EXPECT_EQ(save(numbered(2)), Stored::not_written) << "reads back other bytes";
  storage_.keeps = 0xFF;
  expect(numbered(1));
  storage_.silent = true;
  EXPECT_EQ(save(numbered(2)), Stored::no_answer);
  EXPECT_EQ(load(storage_).stored, Stored::no_answer);
}

TEST(SmallStorage, KeepsOnlyTheChoiceOfTheBuiltInTable) {
  test::MemoryStorage storage(hal::Storage::kSlotBytes);
  TableStore store(storage);
  const Table table = numbered(1);
  EXPECT_EQ(store.save(&table), Stored::not_written);
  EXPECT_EQ(store.save(nullptr), Stored::ok);
  EXPECT_EQ(load(storage).stored, Stored::ok);
}

}  // namespace
}  // namespace whisker::fuzzy

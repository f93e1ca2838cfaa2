#include "firmware/can/rules_server.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "firmware/fuzzy/response_table.hpp"
#include "tests/calibration/memory_storage.hpp"
#include "tests/can/rules_tables.hpp"

namespace whisker::can {
namespace {

using fuzzy::kResponseTable;
using fuzzy::kTableNodes;
using fuzzy::Stored;
using test::same;
using Table = RulesServer::Table;

const std::uint32_t kBuiltInHash = fuzzy::digest(kResponseTable);

Table numbered(int n) {
  Table table{};
  for (std::uint16_t i = 0; i < kTableNodes; ++i) {
    fuzzy::node_of(table, i) = {static_cast<std::int16_t>(i * 17 + n), static_cast<std::int16_t>(n - i * 13)};
  }
  return table;
}

RulesPart part_of(const Table& table, int node, std::uint8_t upload = 1) {
  const auto i = static_cast<std::uint16_t>(node);
  return {upload, i, fuzzy::node_of(table, i)};
}

void send(RulesServer& server, const Table& table, int from = 0, int to = kTableNodes,
          std::uint8_t upload = 1) {
  for (int i = from; i < to; ++i) server.take(part_of(table, i, upload));
}

RulesReply activate(RulesServer& server, const Table& table, std::uint8_t upload = 1) {
  return server.execute({upload, RulesAction::activate, fuzzy::digest(table)});
}

RulesReply restore(RulesServer& server) { return server.execute({1, RulesAction::restore, 0}); }

TEST(RulesServer, HasTheBuiltInTableFirst) {
  RulesServerWith<2> server{kResponseTable};
  EXPECT_EQ(&server.active(), &kResponseTable);
  EXPECT_EQ(server.hash(), kBuiltInHash);
  EXPECT_EQ(server.load(), Stored::nothing);
  EXPECT_EQ(sizeof(Table), 7524U);
}

TEST(RulesServer, AWholeTableIsActivatedByItsHash) {
  const Table table = numbered(1);
  RulesServerWith<2> server{kResponseTable};
  EXPECT_EQ(activate(server, table).status, RulesStatus::incomplete);
  for (int i = 0; i < kTableNodes; ++i) {
    const RulesReply reply = server.take(part_of(table, i));
    EXPECT_EQ(reply.status, RulesStatus::receiving);
    EXPECT_EQ(reply.next, i + 1);
    EXPECT_EQ(server.hash(), kBuiltInHash) << "nothing is active before the order";
  }
  const RulesReply reply = activate(server, table);
  EXPECT_EQ(reply.status, RulesStatus::activated);
  EXPECT_EQ(reply.kept, 0);
  EXPECT_TRUE(same(server.active(), table));
  EXPECT_EQ(server.hash(), fuzzy::digest(table));
  EXPECT_EQ(activate(server, table, 9).status, RulesStatus::activated)
      << "the order again, after a lost reply";
}

TEST(RulesServer, NoPrefixIsActivated) {
  const Table table = numbered(2);
  RulesServerWith<2> server{kResponseTable};
  for (int had = 0; had < kTableNodes; ++had) {
    const RulesReply reply = activate(server, table);
    ASSERT_EQ(reply.status, RulesStatus::incomplete);
    ASSERT_EQ(reply.next, had);
    ASSERT_EQ(&server.active(), &kResponseTable);
    server.take(part_of(table, had));
  }
  EXPECT_EQ(activate(server, table).status, RulesStatus::activated);
}

TEST(RulesServer, EachLostPartIsNamedAndSentAgain) {
  const Table table = numbered(3);
  for (int lost = 0; lost < kTableNodes; ++lost) {
    RulesServerWith<2> server{kResponseTable};
    send(server, table, 0, lost);
    send(server, table, lost + 1);
    const RulesReply reply = activate(server, table);
    ASSERT_EQ(reply.status, RulesStatus::incomplete);
    ASSERT_EQ(reply.next, lost);
    ASSERT_EQ(&server.active(), &kResponseTable);
    send(server, table, lost);
    ASSERT_EQ(activate(server, table).status, RulesStatus::activated);
    ASSERT_TRUE(same(server.active(), table));
  }
}

TEST(RulesServer, EachRepeatedPartChangesNothing) {
  const Table table = numbered(4), other = numbered(5);
  for (int again = 0; again < kTableNodes; ++again) {
    RulesServerWith<2> server{kResponseTable};
    send(server, table, 0, again + 1);
    // With another content, which a right base never sends: only the first one counts.
    ASSERT_EQ(server.take(part_of(other, again)).next, again + 1);
    send(server, table, again + 1);
    ASSERT_EQ(activate(server, table).status, RulesStatus::activated);
    ASSERT_TRUE(same(server.active(), table));
  }
}

TEST(RulesServer, EachPairInTheWrongOrderIsIncomplete) {
  const Table table = numbered(6);
  for (int first = 0; first + 1 < kTableNodes; ++first) {
    RulesServerWith<2> server{kResponseTable};
    send(server, table, 0, first);
    server.take(part_of(table, first + 1));
    send(server, table, first, first + 1);
    send(server, table, first + 2);
    const RulesReply reply = activate(server, table);
    ASSERT_EQ(reply.status, RulesStatus::incomplete);
    ASSERT_EQ(reply.next, first + 1);
    send(server, table, first + 1);
    ASSERT_EQ(activate(server, table).status, RulesStatus::activated);
    ASSERT_TRUE(same(server.active(), table));
  }
}

TEST(RulesServer, AWrongBitInAnyNodeIsTheWrongHash) {
  const Table table = numbered(7);
  const std::uint32_t hash = fuzzy::digest(table);
  const auto refuses = [&](int node, int bit) {
    Table wrong = table;
    auto& answer = fuzzy::node_of(wrong, static_cast<std::uint16_t>(node));
    std::int16_t& half = bit < 16 ? answer.turn : answer.step;
    half = static_cast<std::int16_t>(half ^ static_cast<std::int16_t>(1U << bit % 16));
    RulesServerWith<2> server{kResponseTable};
    send(server, wrong);
    ASSERT_EQ(server.execute({1, RulesAction::activate, hash}).status, RulesStatus::wrong_hash);
    ASSERT_EQ(&server.active(), &kResponseTable);
    ASSERT_EQ(server.execute({1, RulesAction::activate, hash}).status, RulesStatus::incomplete)
        << "its parts are void";
  };
  for (int node = 0; node < kTableNodes; ++node) refuses(node, node % 32);
  for (int bit = 0; bit < 32; ++bit) refuses(1000, bit);
}

TEST(RulesServer, APartOfAnotherUploadStartsAgain) {
  const Table table = numbered(8), other = numbered(9);
  RulesServerWith<2> server{kResponseTable};
  send(server, table, 0, 1000, 1);
  EXPECT_EQ(server.take(part_of(other, 1000, 2)).next, 0);
  EXPECT_EQ(activate(server, table, 1).next, 0);
  send(server, other, 0, kTableNodes, 2);
  EXPECT_EQ(activate(server, other, 1).status, RulesStatus::incomplete) << "the order of another upload";
  EXPECT_EQ(activate(server, other, 2).status, RulesStatus::activated);
  EXPECT_TRUE(same(server.active(), other));
}

TEST(RulesServer, WhatABaseSentBeforeItRestartedIsVoid) {
  const Table table = numbered(10);
  RulesServerWith<2> server{kResponseTable};
  send(server, table, 0, 1000);
  server.forget();
  send(server, table, 1000);
  EXPECT_EQ(activate(server, table).next, 0);
  send(server, table);
  EXPECT_EQ(activate(server, table).status, RulesStatus::activated);
  server.forget();
  EXPECT_TRUE(same(server.active(), table));
}

TEST(RulesServer, WithTwoRoomsTheActiveTableStaysWhileAnotherArrives) {
  RulesServerWith<2> server{kResponseTable};
  Table before = kResponseTable;
  for (int n = 1; n < 6; ++n) {
    const Table table = numbered(n);
    for (int i = 0; i < kTableNodes; ++i) {
      server.take(part_of(table, i));
      ASSERT_TRUE(same(server.active(), before)) << n << ", " << i;
    }
    ASSERT_EQ(activate(server, table).status, RulesStatus::activated);
    before = table;
  }
}

TEST(RulesServer, WithOneRoomTheBuiltInTableIsActiveWhileAnotherArrives) {
  RulesServerWith<1> server{kResponseTable};
  for (int n = 1; n < 4; ++n) {
    const Table table = numbered(n), before = server.active();
    EXPECT_EQ(activate(server, table).status, RulesStatus::incomplete);
    EXPECT_TRUE(same(server.active(), before)) << "no part has come";
    for (int i = 0; i < kTableNodes; ++i) {
      server.take(part_of(table, i));
      ASSERT_EQ(&server.active(), &kResponseTable);
      ASSERT_EQ(server.hash(), kBuiltInHash);
    }
    ASSERT_EQ(activate(server, table).status, RulesStatus::activated);
    ASSERT_TRUE(same(server.active(), table));
  }
}

TEST(RulesServer, RestoresByAnOrderOrByTheHashOfTheBuiltInTable) {
  RulesServerWith<2> server{kResponseTable};
  EXPECT_EQ(restore(server).status, RulesStatus::activated);
  for (const bool by_hash : {true, false}) {
    send(server, numbered(1));
    ASSERT_EQ(activate(server, numbered(1)).status, RulesStatus::activated);
    const RulesReply reply = by_hash ? activate(server, kResponseTable) : restore(server);
    EXPECT_EQ(reply.status, RulesStatus::activated);
    EXPECT_EQ(&server.active(), &kResponseTable);
    EXPECT_EQ(server.hash(), kBuiltInHash);
  }
}

class KeptRules : public testing::Test {
 protected:
  test::MemoryStorage storage_{fuzzy::kTableRecordBytes};
  fuzzy::TableStore store_{storage_};

  /// What a controller has after its next start.
  Table after_restart() {
    RulesServerWith<2> server{kResponseTable, &store_};
    server.load();
    EXPECT_EQ(server.hash(), fuzzy::digest(server.active()));
    return server.active();
  }
};

TEST_F(KeptRules, AreActiveAfterARestartUntilTheyAreRestored) {
  RulesServerWith<2> server{kResponseTable, &store_};
  EXPECT_EQ(server.load(), Stored::nothing);
  for (int n = 1; n < 5; ++n) {
    send(server, numbered(n));
    ASSERT_EQ(activate(server, numbered(n)).kept, 1);
    EXPECT_TRUE(same(after_restart(), numbered(n)));
  }
  ASSERT_EQ(restore(server).kept, 1);
  EXPECT_TRUE(same(after_restart(), kResponseTable));
}

TEST_F(KeptRules, AnUploadThatEndsEarlyLeavesTheOnesBefore) {
  RulesServerWith<1> server{kResponseTable, &store_};
  send(server, numbered(1));
  ASSERT_EQ(activate(server, numbered(1)).kept, 1);
  send(server, numbered(2), 0, kTableNodes - 1);
  EXPECT_EQ(activate(server, numbered(2)).kept, 0);
  EXPECT_TRUE(same(after_restart(), numbered(1)));
}

TEST_F(KeptRules, AnOrderThatIsRepeatedWritesOnce) {
  RulesServerWith<2> server{kResponseTable, &store_};
  send(server, numbered(1));
  ASSERT_EQ(activate(server, numbered(1)).kept, 1);
  const auto slots = storage_.slots;
  ASSERT_EQ(activate(server, numbered(1)).kept, 1);
  EXPECT_EQ(storage_.slots, slots);
}

TEST_F(KeptRules, AStorageThatFailsLeavesTheTableActiveAndSaysSo) {
  RulesServerWith<2> server{kResponseTable, &store_};
  storage_.refuses = true;
  send(server, numbered(1));
  const RulesReply reply = activate(server, numbered(1));
  EXPECT_EQ(reply.status, RulesStatus::activated);
  EXPECT_EQ(reply.kept, 0);
  EXPECT_TRUE(same(server.active(), numbered(1)));
  storage_.refuses = false;
  EXPECT_EQ(activate(server, numbered(1)).kept, 0) << "a repetition does not try again";
  EXPECT_EQ(activate(server, numbered(1), 2).kept, 1) << "the next order does";
  storage_.silent = true;
  RulesServerWith<2> next{kResponseTable, &store_};
  EXPECT_EQ(next.load(), Stored::no_answer);
  EXPECT_EQ(&next.active(), &kResponseTable);
}

TEST_F(KeptRules, ALossOfPowerWhileTheyAreSavedLeavesTheOldOrTheNewOnes) {
  RulesServerWith<2> server{kResponseTable, &store_};
  send(server, numbered(1));
  ASSERT_EQ(activate(server, numbered(1)).kept, 1);
  for (const int bytes : {0, 1, 3000, fuzzy::kTableRecordBytes - 1}) {
    storage_.power = bytes;
    send(server, numbered(2));
    EXPECT_EQ(activate(server, numbered(2)).kept, 0);
    storage_.power = -1;
    EXPECT_TRUE(same(after_restart(), numbered(1)));
    ASSERT_EQ(restore(server).kept, 1);
    send(server, numbered(1));
    ASSERT_EQ(activate(server, numbered(1)).kept, 1);
  }
}

}  // namespace
}  // namespace whisker::can

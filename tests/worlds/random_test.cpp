#include "host/harness/worlds/random.hpp"

#include <gtest/gtest.h>

#include "host/harness/scenario/write.hpp"
#include "host/harness/worlds/generate.hpp"

namespace whisker::worlds {
namespace {

TEST(Random, IsSplitMix64) {
  // The first numbers of the reference program by the algorithm's authors, for this seed.
  Random random(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317U, 3203168211198807973U, 9817491932198370423U, 4593380528125082431U}) {
    EXPECT_EQ(random.bits(), expected);
  }
}

TEST(Random, FillsItsIntervalEvenlyAndStaysInside) {
  Random random(5);
  int tenths[10] = {};
  for (int i = 0; i < 100000; ++i) {
    const double x = random.uniform(-2, 3);
    ASSERT_GE(x, -2);
    ASSERT_LT(x, 3);
    ++tenths[static_cast<int>((x + 2) * 2)];
  }
  // Four standard deviations of a binomial count of 10000 are 380.
  for (const int count : tenths) EXPECT_NEAR(count, 10000, 380);
}

TEST(Random, PicksEveryIndexAndNoOther) {
  Random random(6);
  int counts[7] = {};
  for (int i = 0; i < 7000; ++i) {
    const int k = random.index(7);
    ASSERT_GE(k, 0);
    ASSERT_LT(k, 7);
    ++counts[k];
  }
  for (const int count : counts) EXPECT_NEAR(count, 1000, 120);
}

TEST(Random, TakesItsChances) {
  Random random(7);
  int hits = 0;
  for (int i = 0; i < 10000; ++i) hits += random.chance(0.3) ? 1 : 0;
  EXPECT_NEAR(hits, 3000, 184);
}

// A seed gives the same world with every compiler. After a change of a generator, commit the new hashes.

/// FNV-1a, 64 bits.
std::uint64_t hash(const std::string& text) {
  std::uint64_t h = 0xCBF29CE484222325U;
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  return h;
}

struct Golden {
  Kind kind;
  Options options;
  std::uint64_t hash;
};

const Golden kGolden[] = {
    {Kind::discs, {1, {}, false, false}, 0x64F0849624F86F89U},
    {Kind::discs, {2, 15, false, true}, 0xAA8DD2589526536DU},
    {Kind::discs, {3, 75, true, false}, 0xFAF469207EB99D03U},
    {Kind::poles, {1, {}, false, false}, 0x17B6C6343965FB9FU},
    {Kind::u_trap, {1, {}, false, false}, 0x2C7DC24C6AA8916DU},
    {Kind::u_trap, {2, {}, false, false}, 0xEAE66AFC26C155B3U},
    {Kind::spiral, {1, {}, false, false}, 0xE9FADA0DC29381B2U},
    {Kind::spiral, {2, {}, false, false}, 0x849172D3CCAB1AB1U},
    {Kind::spiral, {3, {}, false, false}, 0xFA7D29B9A2E49BE8U},
    {Kind::maze, {1, {}, false, false}, 0xEC38ECA151F7D2B7U},
    {Kind::maze, {2, {}, false, false}, 0x058E47DA2CBE8841U},
    {Kind::rooms, {1, {}, false, false}, 0xC57EC6870340986CU},
    {Kind::rooms, {2, {}, false, true}, 0x3A6C92236A014162U},
    {Kind::enclosed, {1, {}, false, false}, 0x62CDAE2FF45813FFU},
    {Kind::enclosed, {2, {}, false, false}, 0x8813E0211C140D1AU},
    {Kind::enclosed, {3, 30, true, false}, 0xA1573A8143AB0E4CU},
    {Kind::enclosed_at_wall, {1, {}, false, false}, 0x6192938368EE69D1U},
    {Kind::gap_at_wall, {1, {}, false, false}, 0x7A3E92F668C08F25U},
    {Kind::contest_maze, {1, {}, false, false}, 0xEEB87C1BA4E26D6AU},
    {Kind::gap, {1, {}, false, false}, 0xA68437677F860BC5U},
    {Kind::disc_gap, {2, {}, false, false, {}, 0.225}, 0xFD4E6F009BC8F44FU},
};

TEST(Golden, WorldsAreTheCommittedOnes) {
  for (const Golden& golden : kGolden) {
    const Scenario s = generate(golden.kind, golden.options);
    EXPECT_EQ(hash(to_toml(s)), golden.hash) << s.name;
  }
}

}  // namespace
}  // namespace whisker::worlds

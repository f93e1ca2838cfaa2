#include "host/hunt/hunt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/hunt/folder.hpp"

namespace whisker::hunt {
namespace {

std::set<std::string> rows_of(Options options) {
  std::set<std::string> rows;
  options.show = [&](const Progress&, const Row* row) {
    if (row != nullptr) rows.insert(to_csv(*row));
  };
  hunt(options);
  return rows;
}

Options few() {
  Options options;
  options.seed = 900;
  options.count = 12;
  return options;
}

TEST(Hunt, FreshRowsDependOnTheirSeedsOnly) {
  Options options = few();
  const std::set<std::string> all = rows_of(options);
  EXPECT_EQ(all.size(), 12U);
  options.jobs = 3;
  EXPECT_EQ(rows_of(options), all);
  std::set<std::string> shards;
  options.shards = 2;
  for (options.shard = 0; options.shard < 2; ++options.shard) {
    const std::set<std::string> part = rows_of(options);
    EXPECT_EQ(part.size(), 6U);
    shards.insert(part.begin(), part.end());
  }
  EXPECT_EQ(shards, all);
}

TEST(Hunt, GoesOnWhereItWasEnded) {
  const test::Folder folder;
  Options options = few();
  options.out = folder.path();
  int rows = 0;
  options.show = [&](const Progress&, const Row* row) { rows += row != nullptr; };
  options.stop = [&] { return rows >= 5; };
  hunt(options);
  EXPECT_EQ(rows, 5);
  options.stop = nullptr;
  hunt(options);
  EXPECT_EQ(rows, 12);
  std::set<std::uint64_t> seeds;
  for (const Row& row : read_rows({folder / "rows.csv"})) seeds.insert(row.seed);
  EXPECT_EQ(seeds.size(), 12U);
}

TEST(Hunt, ChangesWhatCameNear) {
  const test::Folder folder;
  Options options;
  options.seed = 900;
  options.time_s = 1e6;
  options.out = folder.path();
  int fresh = 0, changed = 0;
  options.show = [&](const Progress&, const Row* row) {
    if (row != nullptr) ++(row->parent.empty() ? fresh : changed);
  };
  options.stop = [&] { return fresh >= 3 && changed >= 3; };
  hunt(options);
  EXPECT_GE(changed, 3);
}

}  // namespace
}  // namespace whisker::hunt

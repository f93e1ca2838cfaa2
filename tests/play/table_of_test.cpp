#include "host/play/table_of.hpp"

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "firmware/fuzzy/response_table.hpp"

namespace whisker::play {
namespace {

std::vector<double> committed() {
  std::vector<double> list;
  for (const auto& row : fuzzy::kResponseTable.node)
    for (const fuzzy::Bilinear::Node& node : row)
      list.insert(list.end(), {double(node.turn), double(node.step)});
  return list;
}

TEST(TableOf, GivesTheNodesBack) {
  const auto table = table_of(committed());
  ASSERT_TRUE(table);
  EXPECT_EQ(std::memcmp(&*table, &fuzzy::kResponseTable, sizeof *table), 0);
}

TEST(TableOf, AnotherCountIsNone) {
  std::vector<double> list = committed();
  list.pop_back();
  EXPECT_FALSE(table_of(list));
  list.resize(list.size() + 2);
  EXPECT_FALSE(table_of(list));
  EXPECT_FALSE(table_of({}));
}

TEST(TableOf, WhatIsNoAnswerIsNone) {
  for (const double good : {-32767.0, 32767.0, -0.0}) {
    std::vector<double> list = committed();
    list.back() = good;
    EXPECT_TRUE(table_of(list)) << good;
  }
  for (const double bad : {-32768.0, 32768.0, 0.5, 1e300, double(INFINITY), double(NAN)}) {
    std::vector<double> list = committed();
    list[7] = bad;
    EXPECT_FALSE(table_of(list)) << bad;
  }
}

}  // namespace
}  // namespace whisker::play

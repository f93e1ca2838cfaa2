#include "host/page/columns.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace whisker::page {
namespace {

/// The column's numbers, decoded as the header states.
std::vector<std::int64_t> read(const std::string& bytes, Order order) {
  std::vector<std::int64_t> values;
  std::int64_t last = 0, difference = 0;
  for (std::size_t i = 0; i < bytes.size();) {
    std::uint64_t raw = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes[i++]);
      raw |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80) break;
    }
    const auto half = static_cast<std::int64_t>(raw >> 1U);
    const std::int64_t written = (raw & 1U) != 0 ? -half - 1 : half;
    if (order == Order::values) last = written;
    if (order == Order::differences) last += written;
    if (order == Order::second_differences) last += difference += written;
    values.push_back(last);
  }
  return values;
}

RC_GTEST_PROP(Columns, AreReadBackAsTheyWere, ()) {
  constexpr std::int64_t kMost = std::int64_t{1} << 50;
  const auto values = *rc::gen::container<std::vector<std::int64_t>>(
      rc::gen::oneOf(rc::gen::inRange<std::int64_t>(-200, 200), rc::gen::inRange(-kMost, kMost + 1)));
  for (const Order order : {Order::values, Order::differences, Order::second_differences}) {
    Columns columns;
    columns.add("x", order, 1000, values);
    RC_ASSERT(read(columns.bytes(), order) == values);
    RC_ASSERT(columns.list().back().count == values.size());
  }
}

TEST(Columns, AreAsTheHeaderSays) {
  Columns columns;
  columns.add("plain", Order::values, 1, {0, -1, 1, -2, 64});
  EXPECT_EQ(columns.bytes(), std::string("\x00\x01\x02\x03\x80\x01", 6));
  columns.add("line", Order::second_differences, 10, {5, 10, 15, 20});
  EXPECT_EQ(columns.bytes().substr(6), std::string("\x0a\x00\x00\x00", 4));
}

TEST(Columns, AnEvenMotionIsAByteATick) {
  std::vector<std::int64_t> even;
  for (std::int64_t i = 0; i < 1000; ++i) even.push_back(1000000 + 2700 * i);
  Columns columns;
  columns.add("x_m", Order::second_differences, 1000000, even);
  EXPECT_LT(columns.bytes().size(), 1010U);
}

}  // namespace
}  // namespace whisker::page

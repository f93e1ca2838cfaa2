#include "firmware/health.hpp"

#include <cstdint>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace whisker {
namespace {

TEST(Health, EveryFaultHasANameOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i < kFaults; ++i) names.insert(name(static_cast<Fault>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kFaults));
  EXPECT_EQ(names.count("?"), 0U);
  EXPECT_STREQ(name(static_cast<Fault>(kFaults)), "?");
}

TEST(Health, ACounterStopsAtItsMaximum) {
  std::uint32_t counter = UINT32_MAX - 1;
  count(counter);
  EXPECT_EQ(counter, UINT32_MAX);
  count(counter);
  EXPECT_EQ(counter, UINT32_MAX);
}

}  // namespace
}  // namespace whisker

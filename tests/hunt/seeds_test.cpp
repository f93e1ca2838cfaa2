// A short hunt over the same seeds each time. What it finds, `whisker hunt --again SEED` repeats.
#include <gtest/gtest.h>

#include "host/hunt/hunt.hpp"
#include "tests/effort.hpp"

namespace whisker::hunt {
namespace {

constexpr std::uint64_t kFirst = 5000;
constexpr std::uint64_t kSeeds = 300;

/// Faults and missions that give up are for longer hunts.
TEST(Seeds, NothingTouchesCrashesOrDiffers) {
  Options options;
  options.seed = kFirst;
  options.count = test::effort(kSeeds);
  std::uint64_t cases = 0;
  options.show = [&](const Progress&, const Row* row) {
    if (row == nullptr) return;
    ++cases;
    EXPECT_FALSE(harms(row->finding)) << "whisker hunt --again " << row->seed << ": " << row->finding;
  };
  hunt(options);
  EXPECT_EQ(cases, options.count);
}

}  // namespace
}  // namespace whisker::hunt

// A short hunt over the same seeds each time. What it finds, `whisker hunt --again SEED` repeats.
#include <gtest/gtest.h>

#include "host/hunt/hunt.hpp"
#include "tests/effort.hpp"

namespace whisker::hunt {
namespace {

constexpr std::uint64_t kFirst = 5000;
constexpr std::uint64_t kSeeds = 300;

/// Faults and missions that give up are for longer hunts.
bool harms(const Row& row) {
  return row.finding == "contact" || row.finding == "judges_disagree" || row.finding == "other_hash" ||
         row.finding.rfind("crash", 0) == 0;
}

TEST(Seeds, NothingTouchesCrashesOrDiffers) {
  Options options;
  options.seed = kFirst;
  options.count = test::effort(kSeeds);
  std::uint64_t cases = 0;
  options.show = [&](const Progress&, const Row* row) {
    if (row == nullptr) return;
    ++cases;
    EXPECT_FALSE(harms(*row)) << "whisker hunt --again " << row->seed << ": " << row->finding;
  };
  hunt(options);
  EXPECT_EQ(cases, options.count);
}

}  // namespace
}  // namespace whisker::hunt

// Whatever is commanded, at whatever rate, the body touches nothing.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdio>
#include <tuple>

#include "host/campaign/random_robot.hpp"
#include "host/guard/campaign.hpp"
#include "host/guard/drive.hpp"
#include "host/guard/operators.hpp"
#include "tests/effort.hpp"

namespace whisker::test {
namespace {

constexpr int kParts = 4;

class HostileDrives : public testing::TestWithParam<std::tuple<int, bool>> {};

// WHISKER_LONG=1: 100,000 drives of 20 s.
TEST_P(HostileDrives, TouchNothing) {
  const auto [part, noise] = GetParam();
  const auto count = test::effort(34, 12500);
  const std::uint64_t first = 1 + static_cast<std::uint64_t>(part) * 12500 + (noise ? 50000 : 0);
  double path = 0, gap = 1;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const guard::Result result = guard::hostile_drive(seed, noise, {});
    EXPECT_NE(result.end, guard::End::contact) << "seed " << seed << " at " << result.time_s << " s";
    EXPECT_EQ(result.fault, Fault::none) << name(result.fault) << " seed " << seed;
    path += result.path_m;
    gap = std::fmin(gap, result.min_clearance_m);
  }
  std::printf("%llu drives%s from seed %llu: %.0f m, the smallest gap is %.4f m\n",
              static_cast<unsigned long long>(count), noise ? " with noise" : "",
              static_cast<unsigned long long>(first), path, gap);
  EXPECT_GT(path, static_cast<double>(count) * 0.25);
}

INSTANTIATE_TEST_SUITE_P(Part, HostileDrives, testing::Combine(testing::Range(0, kParts), testing::Bool()));

RC_GTEST_PROP(HostileDrive, TouchesNothingFromAnySeed, (std::uint64_t seed, bool noise)) {
  RC_ASSERT(guard::hostile_drive(seed >> 2, noise, {}).end != guard::End::contact);
}

TEST(HostileDrive, TouchesNothingWithAnyRobot) {
  const auto count = test::effort(20, 2000);
  double path = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    Params robot = campaign::random_robot(seed).params;
    robot.bumper = {};
    const guard::Result result = guard::hostile_drive(seed, false, robot);
    EXPECT_NE(result.end, guard::End::contact) << "seed " << seed << " at " << result.time_s << " s";
    path += result.path_m;
  }
  std::printf("%llu robots, %.0f m\n", static_cast<unsigned long long>(count), path);
}

}  // namespace
}  // namespace whisker::test

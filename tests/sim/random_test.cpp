#include "host/sim/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace whisker::sim {
namespace {

constexpr std::uint64_t kSeed = 12345;
constexpr int kCount = 1000000;

/// The largest distance between the sample's and the true distribution function, times the square root of the
/// count: it exceeds 1.95 for one in a thousand seeds (Kolmogorov).
template <class Cdf>
double kolmogorov(std::vector<double> sample, Cdf cdf) {
  std::sort(sample.begin(), sample.end());
  const double n = static_cast<double>(sample.size());
  double worst = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double f = cdf(sample[i]);
    const double below = static_cast<double>(i) / n;
    worst = std::max({worst, std::fabs(f - below), std::fabs(f - below - 1 / n)});
  }
  return worst * std::sqrt(n);
}

TEST(Random, GivesThePublishedNumbersOfXoshiro256PlusPlus) {
  Random random(Random::State{{1, 2, 3, 4}});
  for (const std::uint64_t expected :
       {UINT64_C(41943041), UINT64_C(58720359), UINT64_C(3588806011781223), UINT64_C(3591011842654386),
        UINT64_C(9228616714210784205), UINT64_C(9973669472204895162)}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(Random, UniformNumbersAreUniform) {
  Random random(kSeed, 0);
  std::vector<double> sample;
  for (int i = 0; i < kCount; ++i) {
    sample.push_back(random.uniform());
    ASSERT_TRUE(sample.back() >= 0 && sample.back() < 1) << "seed " << kSeed << " at " << i;
  }
  EXPECT_LT(kolmogorov(sample, [](double x) { return x; }), 1.95) << "seed " << kSeed;
}

TEST(Random, NormalNumbersAreNormal) {
  Random random(kSeed, 1);
  std::vector<double> sample;
  double fourth = 0;
  for (int i = 0; i < kCount; ++i) {
    sample.push_back(random.normal());
    fourth += std::pow(sample.back(), 4) / kCount;
  }
  EXPECT_LT(kolmogorov(sample, [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }), 1.95)
      << "seed " << kSeed;
  // The standard deviation of the fourth power is the square root of 96.
  EXPECT_NEAR(fourth, 3.0, 4 * std::sqrt(96.0 / kCount)) << "seed " << kSeed;
}

TEST(Random, SuccessiveNormalNumbersAreUncorrelated) {
  Random random(kSeed, 2);
  double sum = 0;
  double before = random.normal();
  for (int i = 0; i < kCount; ++i) {
    const double now = random.normal();
    sum += before * now;
    before = now;
  }
  EXPECT_NEAR(sum / kCount, 0, 4 / std::sqrt(double{kCount})) << "seed " << kSeed;
}

TEST(Random, StreamsAndSeedsAreUncorrelated) {
  const auto correlation = [](Random a, Random b) {
    double sum = 0;
    for (int i = 0; i < kCount; ++i) sum += (a.uniform() - 0.5) * (b.uniform() - 0.5);
    return sum / kCount;
  };
  const double bound = 4 / 12.0 / std::sqrt(double{kCount});
  for (std::uint32_t stream = 1; stream < 8; ++stream) {
    EXPECT_NEAR(correlation({kSeed, 0}, {kSeed, stream}), 0, bound) << "stream " << stream;
    EXPECT_NEAR(correlation({kSeed, 0}, {kSeed + stream, 0}), 0, bound) << "seed " << kSeed + stream;
  }
}

TEST(Random, NeighbouringSeedsAndStreamsNeverMeet) {
  // If the stream were added to the seed, (s, 1) would equal (s + 1, 0).
  std::vector<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    for (std::uint32_t stream = 0; stream < 64; ++stream) firsts.push_back(Random(seed, stream).next());
  }
  std::sort(firsts.begin(), firsts.end());
  EXPECT_EQ(std::adjacent_find(firsts.begin(), firsts.end()), firsts.end());
}

TEST(Random, ANormalNumberAlwaysTakesTwoOfTheStream) {
  Random a(kSeed, 3);
  Random b(kSeed, 3);
  for (int i = 0; i < 10000; ++i) {
    a.normal();
    b.next();
    b.next();
    ASSERT_EQ(Random(a).next(), Random(b).next()) << i;
  }
}

}  // namespace
}  // namespace whisker::sim

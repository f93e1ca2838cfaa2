#include "host/lab/campaign/bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/harness/worlds/random.hpp"

namespace whisker::campaign {
namespace {

TEST(Share, IsWilsonsInterval) {
  // Newcombe, Statistics in Medicine 17 (1998), table I, method 3.
  const struct {
    std::uint64_t hits, total;
    double low, high;
  } kKnown[] = {
      {81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0.0000, 0.1611}, {1, 29, 0.0061, 0.1718}};
  for (const auto& known : kKnown) {
    const Estimate e = share(known.hits, known.total);
    EXPECT_DOUBLE_EQ(e.value, static_cast<double>(known.hits) / static_cast<double>(known.total));
    EXPECT_NEAR(*e.low, known.low, 5e-5);
    EXPECT_NEAR(*e.high, known.high, 5e-5);
    const Estimate rest = share(known.total - known.hits, known.total);
    EXPECT_NEAR(*rest.low, 1 - *e.high, 1e-12);
    EXPECT_NEAR(*rest.high, 1 - *e.low, 1e-12);
  }
  EXPECT_EQ(share(0, 1).low, 0);
  EXPECT_EQ(share(5, 5).high, 1);
}

std::vector<double> one_to(int n) {
  std::vector<double> v;
  for (int i = n; i >= 1; --i) v.push_back(i);
  return v;
}

TEST(Quantile, IsAnOrderStatisticBetweenOrderStatistics) {
  // The ranks for the median are those of the sign test (Conover, Practical Nonparametric Statistics, table
  // A3).
  const struct {
    int n;
    double median, low, high;
  } kKnown[] = {{6, 3, 1, 6}, {10, 5, 2, 9}, {20, 10, 6, 15}, {100, 50, 40, 61}};
  for (const auto& known : kKnown) {
    const Estimate e = quantile(one_to(known.n), 0.5);
    EXPECT_EQ(e.value, known.median) << known.n;
    EXPECT_EQ(e.low, known.low) << known.n;
    EXPECT_EQ(e.high, known.high) << known.n;
  }
}

TEST(Quantile, HasNoBoundThatTheSampleCannotGive) {
  EXPECT_FALSE(quantile(one_to(5), 0.5).low);
  EXPECT_FALSE(quantile(one_to(5), 0.5).high);
  // 0.95^72 < 2.5 % < 0.95^71: 72 draws are needed for one above the 95 % point.
  EXPECT_FALSE(quantile(one_to(71), 0.95).high);
  EXPECT_EQ(quantile(one_to(72), 0.95).high, 72);
  EXPECT_EQ(quantile({7}, 0.5).value, 7);
  EXPECT_EQ(quantile(one_to(20), 0.95).value, 19);
  EXPECT_EQ(quantile(one_to(100000), 0.95).value, 95000);
  EXPECT_NEAR(*quantile(one_to(100000), 0.95).high, 95000 + 1.96 * std::sqrt(100000 * 0.95 * 0.05), 2);
}

TEST(Mean, OfAKnownSample) {
  const Estimate e = mean({2, 4, 4, 4, 5, 5, 7, 9});
  const double half = 1.959963984540054 * std::sqrt(32.0 / 7) / std::sqrt(8);
  EXPECT_DOUBLE_EQ(e.value, 5);
  EXPECT_DOUBLE_EQ(*e.low, 5 - half);
  EXPECT_DOUBLE_EQ(*e.high, 5 + half);
  EXPECT_FALSE(mean({3}).low);
}

TEST(Rate, OfEqualSizesIsTheMean) {
  const Estimate e = rate({2, 4, 4, 4, 5, 5, 7, 9}, {2, 2, 2, 2, 2, 2, 2, 2});
  const Estimate m = mean({1, 2, 2, 2, 2.5, 2.5, 3.5, 4.5});
  EXPECT_DOUBLE_EQ(e.value, m.value);
  EXPECT_DOUBLE_EQ(*e.low, *m.low);
  EXPECT_DOUBLE_EQ(*e.high, *m.high);
}

TEST(Rate, OfProportionalAmountsIsCertain) {
  const Estimate e = rate({2, 4, 10}, {1, 2, 5});
  EXPECT_DOUBLE_EQ(e.value, 2);
  EXPECT_NEAR(*e.high - *e.low, 0, 1e-12);
  EXPECT_EQ(rate({0, 1, 0}, {1, 1, 1}).low, 0) << "no rate is negative";
}

/// How often the bounds from n draws contain the true value.
double coverage(double truth, int n, const std::function<double(worlds::Random&)>& draw,
                const std::function<Estimate(const std::vector<double>&)>& estimate) {
  constexpr int kRounds = 4000;
  worlds::Random random(11);
  int within = 0;
  for (int i = 0; i < kRounds; ++i) {
    std::vector<double> sample;
    for (int k = 0; k < n; ++k) sample.push_back(draw(random));
    const Estimate e = estimate(sample);
    if (e.low.value_or(-1e9) <= truth && truth <= e.high.value_or(1e9)) ++within;
  }
  return within / static_cast<double>(kRounds);
}

TEST(Bounds, HoldTheTruthAsOftenAsTheySay) {
  const auto skewed = [](worlds::Random& r) {
    const double u = r.uniform(0, 1);
    return u * u * u;
  };
  for (const int n : {10, 40, 150}) {
    const auto median = [](const std::vector<double>& v) { return quantile(v, 0.5); };
    const auto p95 = [](const std::vector<double>& v) { return quantile(v, 0.95); };
    EXPECT_GT(coverage(0.125, n, skewed, median), 0.945) << n;
    EXPECT_GT(coverage(0.95 * 0.95 * 0.95, n, skewed, p95), 0.945) << n;
  }
  EXPECT_NEAR(coverage(0.25, 150, skewed, mean), 0.95, 0.02);
  EXPECT_LT(coverage(0.125, 150, skewed, [](const std::vector<double>& v) { return quantile(v, 0.5); }),
            0.98);
}

}  // namespace
}  // namespace whisker::campaign

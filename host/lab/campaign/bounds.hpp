/// Statistics with 95 % bounds. Only +, -, *, /, sqrt: the same figures on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace whisker::campaign {

/// A figure and the bounds of its 95 % confidence interval; a bound is absent if the sample is too small.
struct Estimate {
  double value = 0;
  std::optional<double> low, high;
};

/// Share of hits, 0..1: Wilson's score interval (Wilson, JASA 22, 1927). total >= 1.
Estimate share(std::uint64_t hits, std::uint64_t total);

/// Mean, bounds 1.96 standard errors away. Not empty.
Estimate mean(const std::vector<double>& sample);

/// The smallest value with at least the share p (0 < p < 1) of the sample at or below it. Bounds are order
/// statistics whose ranks a binomial count excludes with at most 2.5 % on each side (David and Nagaraja,
/// Order Statistics, 2003, section 7.1): they hold for every distribution. Not empty.
Estimate quantile(std::vector<double> sample, double p);

/// Ratio of the sum of `amounts` to the sum of `sizes`: the ratio estimator and its standard error (Cochran,
/// Sampling Techniques, 1977, section 2.11); the lower bound is at least 0. Equal lengths; sum of sizes > 0.
Estimate rate(const std::vector<double>& amounts, const std::vector<double>& sizes);

}  // namespace whisker::campaign

#include "host/lab/campaign/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace whisker::campaign {
namespace {

constexpr double kZ = 1.959963984540054;  // 97.5 % point of the normal distribution
constexpr double kTail = 0.025;

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

Estimate around(double value, double half_width) { return {value, value - half_width, value + half_width}; }

/// P(count = k) for k = 0..n of a binomial count from the mode outwards, so that no relevant term underflows.
std::vector<double> binomial(std::size_t n, double p) {
  std::vector<double> weight(n + 1, 0);
  const double total = static_cast<double>(n);
  const std::size_t mode = std::min(n, static_cast<std::size_t>((total + 1) * p));
  weight[mode] = 1;
  for (std::size_t k = mode; k < n; ++k) {
    weight[k + 1] = weight[k] * (total - static_cast<double>(k)) / static_cast<double>(k + 1) * p / (1 - p);
  }
  for (std::size_t k = mode; k > 0; --k) {
    weight[k - 1] = weight[k] * static_cast<double>(k) / (total - static_cast<double>(k) + 1) * (1 - p) / p;
  }
  const double all = sum(weight);
  for (double& w : weight) w /= all;
  return weight;
}

}  // namespace

Estimate share(std::uint64_t hits, std::uint64_t total) {
  const double n = static_cast<double>(total);
  const double p = static_cast<double>(hits) / n;
  const double centre = (p + kZ * kZ / (2 * n)) / (1 + kZ * kZ / n);
  const double half = kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n)) / (1 + kZ * kZ / n);
  return {p, hits == 0 ? 0 : centre - half, hits == total ? 1 : centre + half};
}

Estimate mean(const std::vector<double>& sample) {
  const double n = static_cast<double>(sample.size());
  const double value = sum(sample) / n;
  if (sample.size() < 2) return {value, std::nullopt, std::nullopt};
  double squares = 0;
  for (const double x : sample) squares += (x - value) * (x - value);
  return around(value, kZ * std::sqrt(squares / (n - 1) / n));
}

Estimate quantile(std::vector<double> sample, double p) {
  std::sort(sample.begin(), sample.end());
  const std::size_t n = sample.size();
  const double rank = std::ceil(p * static_cast<double>(n) - 1e-9);
  Estimate estimate{sample[static_cast<std::size_t>(std::max(rank, 1.0)) - 1], std::nullopt, std::nullopt};
  // The r-th smallest value exceeds the quantile if fewer than r of the sample lie below the quantile.
  const std::vector<double> probability = binomial(n, p);
  double fewer = 0;
  for (std::size_t r = 1; r <= n; ++r) {
    fewer += probability[r - 1];
    if (fewer <= kTail) estimate.low = sample[r - 1];
  }
  double as_many = 0;
  for (std::size_t r = n; r >= 1; --r) {
    as_many += probability[r];
    if (as_many <= kTail) estimate.high = sample[r - 1];
  }
  return estimate;
}

Estimate rate(const std::vector<double>& amounts, const std::vector<double>& sizes) {
  const double n = static_cast<double>(sizes.size());
  const double size = sum(sizes);
  const double value = sum(amounts) / size;
  if (sizes.size() < 2) return {value, std::nullopt, std::nullopt};
  double squares = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double off = amounts[i] - value * sizes[i];
    squares += off * off;
  }
  Estimate estimate = around(value, kZ * std::sqrt(n / (n - 1) * squares) / size);
  estimate.low = std::max(0.0, *estimate.low);
  return estimate;
}

}  // namespace whisker::campaign

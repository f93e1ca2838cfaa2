#include "host/hil/figures.hpp"

#include <algorithm>
#include <cmath>

namespace whisker::hil {

std::uint32_t percentile(std::vector<std::uint32_t> samples, double part) {
  if (samples.empty()) return 0;
  const double rank = std::ceil(part * static_cast<double>(samples.size()));
  const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  const auto nth = samples.begin() + static_cast<std::ptrdiff_t>(std::min(index, samples.size() - 1));
  std::nth_element(samples.begin(), nth, samples.end());
  return *nth;
}

}  // namespace whisker::hil

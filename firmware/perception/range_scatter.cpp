#include "firmware/perception/range_scatter.hpp"

namespace whisker::perception {

void RangeScatter::add(const RecentReadings& sight) noexcept {
  if (!sight.measured) return;
  const Length next = sight.bend > bend_ ? bend_ + kStep : bend_ - kStep;
  bend_ = max(Length{}, min(next, kMost));
}

}  // namespace whisker::perception

#include "firmware/ranges/scatter.hpp"

namespace whisker::ranges {

void Scatter::add(const Sight& sight) noexcept {
  if (!sight.measured) return;
  const Length next = sight.bend > bend_ ? bend_ + kStep : bend_ - kStep;
  bend_ = max(Length{}, min(next, kMost));
}

}  // namespace whisker::ranges

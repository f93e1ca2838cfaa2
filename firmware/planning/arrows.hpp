/// State diagrams of the machines whose code finds the next phase itself: the arrows that it may follow. The
/// tests ask at every change; a chip spends nothing on it, and there the change is made.
#pragma once

#include <stddef.h>

#include "firmware/math/assert.hpp"

namespace whisker::planning {

template <class Phase>
struct Arrow {
  Phase from;
  Phase to;
};

template <class Phase, size_t kArrows>
constexpr bool leads(const Arrow<Phase> (&arrows)[kArrows], Phase from, Phase to) noexcept {
  for (const Arrow<Phase>& arrow : arrows) {
    if (arrow.from == from && arrow.to == to) return true;
  }
  return false;
}

/// Changes the phase along an arrow.
template <class Phase, size_t kArrows>
constexpr void follow(const Arrow<Phase> (&arrows)[kArrows], Phase& phase, Phase to) noexcept {
  WHISKER_ASSERT(leads(arrows, phase, to));
  static_cast<void>(arrows);
  phase = to;
}

}  // namespace whisker::planning

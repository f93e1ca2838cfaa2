#include "firmware/safety/stall_watch.hpp"

namespace whisker::safety {
namespace {

constexpr int32_t kCounts = 10;

}  // namespace

bool StallWatch::stalled(const localization::CountStep& counts, bool commanded, WheelPair rolling,
                         Duration elapsed, const Params& params) noexcept {
  if (!commanded || counts.left != 0 || counts.right != 0) {
    reset();
    return false;
  }
  for_ = min(for_ + elapsed, derived::kMostStalledAfter * 2);
  missing_[0] += rolling.left * elapsed;
  missing_[1] += rolling.right * elapsed;
  const Length most = millimetres(1000 * kCounts) / params.wheels.counts_per_metre;
  return derived::outlasts_a_stall(for_, params) && max(abs(missing_[0]), abs(missing_[1])) > most;
}

}  // namespace whisker::safety

#include "firmware/planning/calibration/range_profile.hpp"

namespace whisker::planning {

void RangeProfile::add(int beam, int32_t at, uint16_t mm, bool echo) noexcept {
  const int count = count_[beam];
  if (at < 0 || at > int32_t{UINT16_MAX} || count == kMost) return;
  if (count > 0 && at < samples_[beam][count - 1].at + kSpacing) return;
  samples_[beam][count] = {static_cast<uint16_t>(at), mm};
  count_[beam] = static_cast<int16_t>(count + 1);
  if (echo) ++echoes_;
}

}  // namespace whisker::planning

#include "host/harness/sim/fixes.hpp"

#include "host/harness/sim/streams.hpp"

namespace whisker::sim {

Fixes::Fixes(const NoiseSpec& noise, uint64_t seed)
    : every_m_(noise.fix_every_m),
      sigma_m_(noise.fix_sigma_m),
      sigma_rad_(noise.fix_sigma_rad),
      random_(seed, kStreamFix) {}

bool Fixes::take(const Pose& truth, double path_m, Pose& fix) {
  if (!(every_m_ > 0) || path_m - last_m_ < every_m_) return false;
  last_m_ = path_m;
  fix = truth;
  fix.at.x += sigma_m_ * random_.normal();
  fix.at.y += sigma_m_ * random_.normal();
  fix.heading += sigma_rad_ * random_.normal();
  return true;
}

}  // namespace whisker::sim

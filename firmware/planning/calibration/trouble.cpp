#include "firmware/planning/calibration/trouble.hpp"

namespace whisker::planning {

const char* name(Trouble trouble) noexcept {
  switch (trouble) {
    case Trouble::none: return "none";
    case Trouble::not_finished: return "not_finished";
    case Trouble::blocked: return "blocked";
    case Trouble::too_slow: return "too_slow";
    case Trouble::body_moved: return "body_moved";
    case Trouble::gyro_lost: return "gyro_lost";
    case Trouble::no_gyro: return "no_gyro";
    case Trouble::nothing_in_range: return "nothing_in_range";
    case Trouble::no_features: return "no_features";
    case Trouble::scene_moved: return "scene_moved";
    case Trouble::ambiguous: return "ambiguous";
    case Trouble::too_uncertain: return "too_uncertain";
  }
  return "?";
}

}  // namespace whisker::planning

/// Why a calibration has no result.
#pragma once

#include <stdint.h>

namespace whisker::planning {

enum class Trouble : uint8_t {
  none,
  not_finished,      ///< it is still driving, or was cancelled
  blocked,           ///< the guard granted no movement for 3 s: more free ground is needed
  too_slow,          ///< it took more than twice the time that it should
  body_moved,        ///< the body left its place while it turned: it was pushed or slipped
  gyro_lost,         ///< the gyro fell silent on the way, or answered only then
  no_gyro,           ///< a straight drive compares the wheels with a gyro
  nothing_in_range,  ///< the beams see hardly anything
  no_features,       ///< what they see looks the same from all sides
  scene_moved,       ///< the last turn saw another scene than the first one
  ambiguous,         ///< the scene looks the same at two headings
  too_uncertain,     ///< the result would be off by more than half a per cent, one standard deviation
  does_not_fit,      ///< the robot would refuse its parameters with these values
  no_drive,          ///< a tape tells nothing without a drive along it just before
  wrong_tape,        ///< the tape's length is more than 20 % away from the wheels'
};
constexpr int kTroubles = 15;
constexpr const char* name(Trouble trouble) noexcept {
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
    case Trouble::does_not_fit: return "does_not_fit";
    case Trouble::no_drive: return "no_drive";
    case Trouble::wrong_tape: return "wrong_tape";
  }
  return "?";
}

}  // namespace whisker::planning

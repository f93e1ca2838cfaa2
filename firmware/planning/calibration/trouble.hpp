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
};
constexpr int kTroubles = 12;
const char* name(Trouble trouble) noexcept;

}  // namespace whisker::planning

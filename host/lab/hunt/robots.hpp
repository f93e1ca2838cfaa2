/// Robots drawn over every key that check() accepts.
#pragma once

#include <cstdint>

#include "firmware/params.hpp"
#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

/// Keys that are drawn together, because check() refuses nearly every single change of one of them.
enum class Family {
  none,       ///< single keys only
  lag,        ///< motors that follow late
  ticks,      ///< long periods, long gaps between ticks
  cells,      ///< coarse cells, no margins
  turns,      ///< high turn rates, old readings
  encoders,   ///< few counts
  brakes,     ///< weak brakes at high turn rates
  mounts,     ///< each beam with a place, a direction and a range of its own
  near,       ///< large minimum ranges
  incidence,  ///< sensors that lose walls at an angle
  readings,   ///< rates and latencies at the ends
  bumper,
  gyro,
  errors,  ///< declared errors of the pose
};
constexpr int kFamilies = static_cast<int>(Family::errors) + 1;
const char* name(Family family);

struct Share {
  std::uint64_t drawn = 0;
  std::uint64_t accepted = 0;
};

struct DrawnRobot {
  Params params;  ///< drivable()
  Family family = Family::none;
  Share families;  ///< draws of the family as a whole
  Share keys;      ///< draws of single keys
};

/// check() accepts it, and no wall that it may hit is invisible to its beams as far as `whisker robot check`
/// knows.
bool drivable(const Params& params);

DrawnRobot draw_robot(Dice& dice);
/// Draws up to `count` keys anew, each one only if the robot stays drivable.
Share change_keys(Dice& dice, Params& params, int count);

}  // namespace whisker::hunt

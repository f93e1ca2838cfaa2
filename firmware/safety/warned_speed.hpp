/// The limit of the forward speed while clear ground is in doubt.
#pragma once

#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/safety/warning.hpp"

namespace whisker::safety {

class WarnedSpeed {
 public:
  void configure(const Params& params) noexcept {
    for (int err = 0; err < 2; ++err) speed_[err] = warned_speed(params, err != 0);
  }
  /// While the rims turn at `turning`. `err`, `slows`: see Perception::readings_err() and slows(). If the
  /// readings contradict the parameters on which the warned speed rests, at most half the full speed.
  Speed most(Speed turning, bool err, bool slows, const Params& params) const noexcept {
    const Speed warned = speed_[err ? 1 : 0];
    const Speed straight = slows ? min(warned, params.wheels.max_speed / 2) : warned;
    return warned_speed(straight, turning);
  }

 private:
  Speed speed_[2];  // the second one if readings err
};

}  // namespace whisker::safety

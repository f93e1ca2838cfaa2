/// The time in which a robot has no controller: its frames are lost, or it restarts. As on the bus, the base
/// holds the last command until a new one is late, brakes, and lets the robot go on once the wheels stand.
#pragma once

#include <cstdint>

#include "firmware/can/braking.hpp"
#include "firmware/can/limits.hpp"
#include "firmware/params.hpp"
#include "host/harness/sim/plant.hpp"

namespace whisker {

/// The change of a wheel's speed per period while the base brakes, in 0.1 mm/s.
std::int16_t braking_step(const Params& params);

class LinkLoss {
 public:
  enum class Step : std::uint8_t {
    up,       ///< nothing is lost
    hold,     ///< no tick of the robot; the wheels keep the last command
    brake,    ///< no tick of the robot; the base brakes
    back,     ///< the robot ticks again, and the base has not braked
    resume,   ///< the wheels stand after a loss: the base resumes the mission, and the robot ticks
    restart,  ///< the wheels stand after a restart: the mission starts anew, and the robot ticks
  };

  explicit LinkLoss(const Params& params)
      : period_ms_(static_cast<std::uint32_t>(params.safety.period.raw())), slower_(braking_step(params)) {}

  void lose(double for_s);
  void restart() { restarts_ = true; }
  bool restarts() const { return restarts_; }
  bool lost() const { return restarts_ || ticks_ > 0 || silent_ms_ > 0; }
  /// Once a tick. command: the last one that the wheels got.
  Step step(hal::WheelSpeeds command, const sim::Plant& plant);
  /// The command of a tick of `brake`.
  hal::WheelSpeeds slowed(hal::WheelSpeeds command) const { return can::slowed(command, slower_); }
  /// After `back`: the controller missed readings for so long that it has braked, too.
  bool held() const { return gap_ms_ > can::kHoldAfter_ms; }
  /// A loss of that length stops the base.
  bool stops(double for_s) const;

 private:
  std::uint64_t ticks_of(double for_s) const;

  std::uint32_t period_ms_;
  std::int16_t slower_;
  std::uint64_t ticks_ = 0;      // still to be lost
  std::uint64_t silent_ms_ = 0;  // since the last command
  std::uint64_t gap_ms_ = 0;
  bool braking_ = false;
  bool restarts_ = false;
};

}  // namespace whisker

/// What the core promises at every tick, whatever the board does.
#pragma once

#include <cstdint>
#include <string>

#include "firmware/robot.hpp"

namespace whisker::test {

class Watch {
 public:
  explicit Watch(const Params& params);
  /// The first promise that this tick broke; empty if it kept them all.
  /// elapsed: since the tick before, as the core takes it.
  std::string see(const Status& status, Duration elapsed, bool refused);
  /// The caller has reset the robot.
  void forgive() { fault_ = Fault::none; }

 private:
  std::string speeds(const Status& status, bool refused);
  std::string faults(const Status& status, Duration elapsed);
  std::string counters(const Health& now);

  int32_t top_;  // 0.1 mm/s
  Acceleration acceleration_;
  int32_t change_ = 0;  // 0.1 mm/s at this tick
  Duration to_stand_;   // from a fault
  hal::WheelSpeeds last_{};
  Health health_;
  Fault fault_ = Fault::none;
  Duration faulted_for_;
};

}  // namespace whisker::test

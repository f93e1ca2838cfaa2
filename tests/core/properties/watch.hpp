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
  std::string see(const Status& status, bool refused);
  /// The caller has reset the robot.
  void forgive() { fault_ = Fault::none; }

 private:
  std::string speeds(const Status& status, bool refused);
  std::string faults(const Status& status);
  std::string counters(const Health& now);

  int32_t top_;             // 0.1 mm/s
  int32_t change_;          // 0.1 mm/s a tick
  int32_t ticks_to_stand_;  // from a fault
  hal::WheelSpeeds last_{};
  Health health_;
  Fault fault_ = Fault::none;
  int32_t faulted_ticks_ = 0;
};

}  // namespace whisker::test

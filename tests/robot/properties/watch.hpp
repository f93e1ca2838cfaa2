/// The guarantees of the core at every tick, for any board.
#pragma once

#include <cstdint>
#include <string>

#include "firmware/robot.hpp"

namespace whisker::test {

class Watch {
 public:
  explicit Watch(const Params& params);
  /// The first guarantee violated in this tick; empty if none. elapsed: since the previous tick, as the core
  /// limits it.
  std::string see(const Status& status, Duration elapsed, bool refused);
  /// Call after a reset of the robot.
  void forgive() { fault_ = Fault::none; }

 private:
  void reach();
  std::string speeds(const Status& status, bool refused);
  std::string faults(const Status& status, Duration elapsed);
  std::string counters(const Health& now);

  int32_t top_;                 // 0.1 mm/s
  double reached_[2] = {0, 0};  // by the wheels, and how much they follow in this tick; 0.1 mm/s
  double follows_ = 0;
  Acceleration acceleration_;
  int32_t change_ = 0;  // 0.1 mm/s in this tick
  Duration to_stand_;   // from a fault
  hal::WheelSpeeds last_{};
  Health health_;
  Fault fault_ = Fault::none;
  Duration faulted_for_;
};

}  // namespace whisker::test

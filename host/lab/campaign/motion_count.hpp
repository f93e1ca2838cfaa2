/// Counts how smoothly a robot drives, from the true motion, tick by tick.
#pragma once

#include <cstdint>

#include "host/harness/run/record.hpp"

namespace whisker::campaign {

class MotionCount {
 public:
  static constexpr double kDriving_mps = 0.05;    ///< above this forward speed, the robot drives
  static constexpr double kStanding_mps = 0.01;   ///< below it, the robot stands (or reverses)
  static constexpr double kTurning_radps = 0.20;  ///< a slower turn has no side

  /// track_m: between the wheels, > 0.
  explicit MotionCount(double track_m) : track_m_(track_m) {}

  void add(const TickRecord& record);

  double turned_rad() const { return turned_rad_; }  ///< sum of the absolute changes of heading
  /// How often it stopped and drove on, after its first start.
  std::uint64_t stops() const { return stops_; }
  std::uint64_t flips() const { return flips_; }  ///< turns to the other side than the last turn
  std::uint64_t looks() const { return looks_; }  ///< sequences of ticks with a decision from a static scan

 private:
  enum class Pace { not_yet, driving, standing };

  void add_speed(double speed_mps);
  void add_turn_rate(double rate_radps);

  double track_m_;
  bool first_ = true;
  double heading_rad_ = 0;
  double turned_rad_ = 0;
  Pace pace_ = Pace::not_yet;
  int side_ = 0;
  bool looked_ = false;
  std::uint64_t stops_ = 0, flips_ = 0, looks_ = 0;
};

}  // namespace whisker::campaign

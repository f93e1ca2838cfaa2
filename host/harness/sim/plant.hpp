/// The simulated robot in its world: wheels, body, contact, encoders and rangefinders, one control period at
/// a time. docs/scenario.md describes the models and their exactness.
#pragma once

#include <stdint.h>

#include "hal/types.hpp"
#include "host/harness/sim/encoders.hpp"
#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/gyro.hpp"
#include "host/harness/sim/motion.hpp"
#include "host/harness/sim/range_sensors.hpp"
#include "host/harness/sim/slip.hpp"
#include "host/harness/sim/spec.hpp"
#include "host/harness/sim/wheel.hpp"
#include "host/harness/sim/world.hpp"

namespace whisker::sim {

class Plant {
 public:
  /// The robot stands still at `start`; its sensors take their first measurement at time 0. The world is kept
  /// by reference: it must outlive the plant, and its owner may change it between two calls.
  Plant(const WorldView& world, const RobotSpec& robot, const NoiseSpec& noise, uint64_t seed, Pose start);
  Plant(const WorldView&&, const RobotSpec&, const NoiseSpec&, uint64_t, Pose) = delete;

  /// Sets the target of the wheels.
  void command(hal::WheelSpeeds speeds);
  /// Simulates one control period. After a contact, the body stays there with its wheels at rest; time and
  /// sensors continue.
  void advance();

  hal::RangeReadings ranges() const { return sensors_.read(now_us_); }
  hal::EncoderCounts encoders() const { return encoders_.counts(); }
  /// All open without a bumper.
  hal::BumperReading bumper() const { return {pressed_}; }
  hal::GyroReading gyro() const { return gyro_.read(now_us_); }
  /// False without a gyro, and after its death.
  bool gyro_answers() const { return has_gyro_ && time() < gyro_dies_; }

  /// True values, SI units.
  Pose pose() const { return pose_; }
  double v_left() const { return v_left_; }
  double v_right() const { return v_right_; }
  double time() const { return static_cast<double>(now_us_) * 1e-6; }
  bool in_contact() const { return contact_; }
  double contact_time() const { return contact_time_; }  ///< -1 before a contact
  /// Touches that pressed a switch. The body stops there, but they are no contact.
  uint32_t bumps() const { return bumps_; }
  /// The smallest gap so far, at most kClearanceSlack above the true one; 0 or less after a contact; infinite
  /// in an empty world.
  double min_clearance() const { return min_clearance_; }
  double path_length() const {
    return path_length_;
  }  ///< of the body's centre, turning on the spot adds none

 private:
  double gap_now();
  double farthest_travel() const;
  void sense(const Arc& arc, double free_fraction);  // measurements that are due during the last step
  void touch(double time);
  bool press(const Pose& at);  // false: this touch presses no switch, so it is a contact
  void release();

  const WorldView* world_;
  double radius_;
  double track_;
  double max_speed_;
  double press_speed_;
  int64_t period_us_;
  int64_t step_us_;
  WheelModel wheel_;
  Encoders encoders_;
  WheelSlip slip_[2];
  Gyro gyro_;
  bool has_gyro_;
  double gyro_dies_;
  RangeSensors sensors_;

  int64_t now_us_ = 0;
  Pose pose_;
  double target_left_ = 0;
  double target_right_ = 0;
  double v_left_ = 0;
  double v_right_ = 0;
  uint8_t pressed_ = 0;
  uint32_t bumps_ = 0;
  bool contact_ = false;
  double contact_time_ = -1;
  double min_clearance_ = 0;
  double path_length_ = 0;
};

}  // namespace whisker::sim

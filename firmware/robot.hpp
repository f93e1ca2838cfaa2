/// The whole core: ranges -> nav (with its fuzzy table) -> motion -> wheels, once a tick.
#pragma once

#include <stdint.h>

#include "firmware/core/trig.hpp"
#include "firmware/core/units.hpp"
#include "firmware/health.hpp"
#include "firmware/mapper.hpp"
#include "firmware/motion/driver.hpp"
#include "firmware/motion/odometry.hpp"
#include "firmware/nav/planner.hpp"
#include "firmware/params.hpp"
#include "firmware/ranges/conditioner.hpp"
#include "hal/drive.hpp"
#include "hal/rangefinders.hpp"

namespace whisker {

/// What happened in the last tick.
struct Status {
  nav::Decision decision;
  Pose pose;                   ///< estimated
  ranges::Echoes echoes;       ///< the latest reading of each beam by itself
  hal::WheelSpeeds command{};  ///< as given to the drive
  Health health;
};

/// One robot. Allocates nothing, waits for nothing; a tick's work is bounded.
///
///   Robot robot{rangefinders, drive, planner, params};
///   robot.place({{0_m, 0_m}, 0_deg});
///   robot.set_goal({{4_m, 1_m}, 100_mm});
///   every 10 ms:  robot.tick(Time::from_raw(clock.now_ms()));
///
/// A failure ends in the safe state: both wheels slow down at the acceleration limit to zero, stay
/// there, and status().health.fault names the cause until reset(). All references must outlive the robot,
/// and the parameters must not change while it lives.
class Robot {
 public:
  Robot(hal::Rangefinders& rangefinders, hal::Drive& drive, nav::Planner& planner,
        const Params& params) noexcept;

  /// Tells the robot where it stands. It takes the wheels' next counts as zero.
  void place(const Pose& pose) noexcept;
  /// Accepted in any state; one given while a fault stands is dropped by reset().
  void set_goal(const nav::Goal& goal) noexcept;
  void cancel() noexcept;
  /// Clears the fault and forgets all readings; the goal must be set again. Parameters that check() refused
  /// at construction stay refused.
  void reset() noexcept;

  /// One control tick. `now` is the time of this tick, about params.safety.period after the last.
  const Status& tick(Time now) noexcept;
  const Status& status() const noexcept { return status_; }

 private:
  void check_clock(Time now) noexcept;
  void sense(Time now) noexcept;
  bool measure(motion::CountStep& step) noexcept;
  void navigate() noexcept;
  void watch_look(bool settled) noexcept;
  void drive(const motion::CountStep* counts) noexcept;
  void watch_driver() noexcept;
  bool overdue(int32_t ticks) const noexcept;
  void show_fault() noexcept;
  void fail(Fault fault) noexcept;
  bool faulted() const noexcept { return status_.health.fault != Fault::none; }

  hal::Rangefinders& rangefinders_;
  hal::Drive& drive_;
  nav::Planner& planner_;
  const Params& params_;

  ranges::Conditioner conditioner_;
  motion::Odometry odometry_;
  motion::Driver driver_;
  Mapper mapper_;
  Status status_;

  Time last_tick_;
  Time settled_since_;
  bool started_ = false;
  bool was_settled_ = false;
  bool beams_fresh_ = false;
  int32_t drive_refusals_ = 0;
  int32_t encoder_refusals_ = 0;
};

}  // namespace whisker

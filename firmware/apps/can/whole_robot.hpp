#pragma once

#include <stdint.h>

#include "firmware/apps/can/base.hpp"
#include "firmware/apps/can/inner_bus.hpp"
#include "firmware/apps/can/keeping_controller.hpp"
#include "firmware/can/param_store.hpp"
#include "hal/button.hpp"

namespace whisker::can_app {

/// What a person sees of a robot.
enum class Sign : uint8_t {
  starts,      ///< its sensors do not measure yet
  rests,       ///< it waits for a goal
  drives,      ///< to a goal
  calibrates,  ///< drives to measure itself
  failed,      ///< a fault, or a stop that has a cause: the button, or a new start, ends it
};

/// A whole robot on one chip: controller and base, which talk over a bus inside of the program, so that a
/// cable to the port `line` shows all of their frames, and an operator on it gives goals and parameters
/// (docs/can.md).
///
/// It stands after its start, with the place where it stands as its origin, and takes the goals of an
/// operator. Its button, pressed briefly, sends it kAhead straight ahead; held, it turns on the spot to
/// measure its track and its gyro. A press while it drives stops it. Parameters that an operator commits are
/// kept, and hold at once: the place where it stands is its origin again.
///
///   WholeRobot robot{line, boot, defaults, devices, stores};
///   board.adopt(robot.params());
///   every millisecond:  if (robot.poll(now)) board.adopt(robot.params());
///   every period:       robot.tick(now);
class WholeRobot {
 public:
  static constexpr Length kAhead = 2000_mm;
  /// A sensor that does not measure after this time is a lost one.
  static constexpr uint32_t kSensorsStart_ms = 2000;
  /// After a stop that an operator or a lost frame caused, it takes goals again once it has stood for so
  /// long.
  static constexpr uint32_t kRest_ms = 1000;

  /// Without a bumper or a gyro: null. The parameters say whether those that are there are used.
  struct Devices {
    hal::Rangefinders& rangefinders;
    hal::Drive& drive;
    hal::Button& button;
    hal::Bumper* bumper;
    hal::Gyro* gyro;
  };
  struct Stores {
    hal::Storage& tables;
    hal::Storage& calibration;
    hal::Storage& params;
  };

  /// defaults: until an operator has committed others; check() accepts them. boot: another number at each
  /// start. All must outlive it.
  WholeRobot(hal::CanPort& line, uint16_t boot, const Params& defaults, const Devices& devices,
             const Stores& stores) noexcept;
  WholeRobot(const WholeRobot&) = delete;
  WholeRobot& operator=(const WholeRobot&) = delete;

  /// Call it every millisecond. True: params() has changed, while the wheels stand. Blocks as
  /// hal::Storage::erase() after a commit, and after a calibration.
  bool poll(uint32_t now_ms) noexcept;
  /// One control period: reads the sensors, steps, and commands the wheels.
  void tick(uint32_t now_ms) noexcept;

  const Params& params() const noexcept { return params_; }
  const Status& status() const noexcept { return keeping_.controller().status(); }
  Sign sign() const noexcept;

 private:
  enum class Wish : uint8_t { none, rest, ahead, spin, stop };

  void on_press(hal::Press press) noexcept;
  void see_end() noexcept;
  bool adopt() noexcept;
  void follow() noexcept;
  void give(can::Order order, Length ahead) noexcept;
  bool sensors_measure() noexcept;
  bool drives() const noexcept;

  InnerBus bus_;
  can::ParamStore store_;
  Params params_;
  const Devices devices_;
  KeepingController keeping_;
  can::BaseNode node_;
  StaticStorage<sizeof(Base)> room_for_base_;
  Base* base_ = nullptr;
  uint32_t now_ms_ = 0;
  uint32_t tick_ = 0;
  uint32_t commits_ = 0;
  uint32_t stopped_ms_ = 0;
  Wish wish_ = Wish::rest;
  can::Order given_ = can::Order::cancel;
  bool measures_ = false;  // all sensors have measured, or have had their time
  bool must_adopt_ = false;
};

}  // namespace whisker::can_app

#pragma once

#include "hal/boards/common/governed_wheels.hpp"
#include "hal/boards/common/schedule.hpp"
#include "hal/boards/pico/echo_lines.hpp"
#include "hal/boards/pico/encoders.hpp"
#include "hal/boards/pico/flash_storage.hpp"
#include "hal/boards/pico/led.hpp"
#include "hal/boards/pico/motors.hpp"
#include "hal/boards/pico/robot_params.hpp"
#include "hal/boards/pico/sensor_bus.hpp"
#include "hal/boards/pico/switches.hpp"
#include "hal/boards/pico/ticker.hpp"
#include "hal/boards/pico/uart_line.hpp"
#include "hal/boards/pico/usb_line.hpp"

namespace whisker::hal::pico {

using Wheels = mcu::GovernedWheels<Motors, Encoders>;

/// All drivers of the board; a failed one counts its failures.
///
///   if (!board.start()) board.refuse();
///   for (;;) { board.sleep(); board.poll(); if (board.due(10)) ...; }
class RobotBoard {
 public:
  static constexpr uint32_t kWatchdogMs = 200;

  RobotBoard() noexcept = default;
  RobotBoard(const RobotBoard&) = delete;
  RobotBoard& operator=(const RobotBoard&) = delete;

  /// Call once. The motors are off until drive() is used. False: the crystal does not run, or the image is
  /// damaged.
  bool start() noexcept;
  /// After start() has failed: flashes five times a second, for ever. The motor driver sleeps.
  [[noreturn]] void refuse() noexcept;
  /// Starts the watchdog and the motor driver.
  void watch() noexcept;
  /// Until the next millisecond.
  void sleep() noexcept { ticker_.sleep(); }
  /// Every millisecond: switches, button, counters.
  void poll() noexcept;
  /// True once per period. Also feeds the watchdog.
  bool due(uint32_t period_ms) noexcept;
  uint32_t now_ms() noexcept { return ticker_.now_ms(); }
  /// For who measures how long a tick takes.
  void mark_tick(bool runs) noexcept;
  /// Differs from that of the last start: noise of the ring oscillator.
  uint16_t boot_number() noexcept;

  Rangefinders& rangefinders() noexcept { return fitted_; }
  hal::Gyro& gyro() noexcept { return sensors_.gyro(); }
  Drive& drive() noexcept { return wheels_; }
  /// Rangefinders, gyro and the speed controllers follow these parameters. Only while the wheels stand.
  void adopt(const Params& params) noexcept;
  Bumper& bumper() noexcept { return bumper_; }
  hal::Button& button() noexcept { return button_; }
  ByteLine& line() noexcept { return line_; }
  ByteLine& usb() noexcept { return usb_; }
  Led& led() noexcept { return led_; }
  Storage& storage(FlashUse use) noexcept { return storage_[static_cast<uint8_t>(use)]; }
  const Troubles& troubles() const noexcept { return troubles_; }

  void on_millisecond() noexcept;
  void on_usb_interrupt() noexcept { usb_.on_interrupt(); }
  void on_line_interrupt() noexcept { line_.on_interrupt(); }
  void on_bus_interrupt() noexcept { sensors_.on_interrupt(); }
  void on_edge_interrupt() noexcept { echoes_.on_interrupt(); }

 private:
  void start_usb() noexcept;

  /// The rangefinders that the parameters say are fitted.
  class FittedRangers final : public Rangefinders {
   public:
    explicit FittedRangers(Rangefinders& first) noexcept : rangers_(&first) {}
    void choose(Rangefinders& rangers) noexcept { rangers_ = &rangers; }
    bool read(RangeReadings& out) noexcept override { return rangers_->read(out); }

   private:
    Rangefinders* rangers_;
  };

  Troubles troubles_;
  Ticker ticker_;
  UartLine line_;
  UsbLine usb_;
  SensorBus sensors_;
  EchoLines echoes_;
  FittedRangers fitted_{sensors_.rangers()};
  Motors motors_;
  Encoders encoders_;
  Wheels wheels_{motor_of(kRobotParams), motor_of(kRobotParams), motors_, encoders_, ticker_};
  BumpSwitches bumper_;
  PushButton button_;
  Led led_;
  Watchdog watchdog_;
  FlashStorage storage_[kFlashUses] = {{FlashUse::response_table, watchdog_},
                                       {FlashUse::calibration, watchdog_},
                                       {FlashUse::parameters, watchdog_}};
  mcu::Schedule schedule_;
};

}  // namespace whisker::hal::pico

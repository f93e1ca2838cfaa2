#pragma once

#include "hal/boards/pico/gyro.hpp"
#include "hal/boards/pico/rangers.hpp"

namespace whisker::hal::pico {

/// The bus with three rangefinders and a gyro. Each millisecond, all are asked in turn; the interrupt at the
/// end of a transfer begins the next one, so that a long tick delays no reading.
class SensorBus {
 public:
  static constexpr uint32_t kTransferMs = 3;  ///< the longest takes 0.4 ms

  void start(uint32_t now_ms) noexcept;
  /// Adds what has failed since the last call.
  void collect(Troubles& troubles) noexcept;
  /// What the parameters say of the gyro. ranged: the rangefinders are on this bus; without, their reset pins
  /// are left low. While no handler runs.
  void adopt(const GyroParams& gyro, bool ranged) noexcept;

  Rangers& rangers() noexcept { return rangers_; }
  Gyro& gyro() noexcept { return gyro_; }

  /// In the handler of the millisecond.
  void on_millisecond() noexcept;
  /// Handler of the bus.
  void on_interrupt() noexcept;

 private:
  static constexpr uint8_t kGyro = kBeams;  // the turn after those of the rangefinders
  void serve(uint8_t turn) noexcept;
  bool succeed() noexcept;
  void fail() noexcept;

  I2c bus_;
  Rangers rangers_;
  Gyro gyro_;
  mcu::Events no_answer_, timeouts_;
  uint32_t now_ms_ = 0;
  uint32_t begun_ms_ = 0;
  uint8_t turn_ = 0;
  uint8_t first_ = 0;  // turn of a millisecond
  bool busy_ = false;
};

}  // namespace whisker::hal::pico

#pragma once

#include "hal/boards/common/mpu6050.hpp"
#include "hal/boards/stm32f405/i2c.hpp"
#include "hal/gyro.hpp"

namespace whisker::hal::stm32f405 {

namespace mpu6050 = mcu::mpu6050;
using mcu::Facing;

/// The gyro of an MPU-6050 on I2C.
///
/// ```
/// held -> resetting -> settling -> sampling
///   ^         |            |           |
///   +---------+------------+-----------+      did not start, silent, or lost samples: tried again
/// ```
/// The FIFO keeps the samples of 5 s at 100 Hz, so a late poll loses none. Where samples are lost, the sums
/// would lack a turn that the core could not notice. So the driver then does not answer until the chip is
/// started again, which takes longer than the 100 ms after which the core counts the gyro as lost.
class Mpu6050 final : public hal::Gyro {
 public:
  static constexpr uint32_t kHeldMs = 100;   ///< before the next try
  static constexpr uint32_t kPollMs = 4;     ///< between two looks into the FIFO
  static constexpr uint32_t kSilentMs = 60;  ///< without a sample for this long, the chip is started again

  enum class Phase : uint8_t { held, resetting, settling, sampling };

  /// All must outlive it.
  Mpu6050(const GyroParams& gyro, Facing facing, I2c& bus, Troubles& troubles) noexcept
      : setup_(mpu6050::setup_of(gyro)), facing_(facing), bus_(bus), troubles_(troubles) {}

  void start(uint32_t now_ms) noexcept { enter(Phase::held, now_ms); }
  /// A few transfers at most. Call it several times per tick.
  void poll(uint32_t now_ms) noexcept;

  bool read(hal::GyroReading& out) noexcept override;
  Phase phase() const noexcept { return phase_; }

 private:
  void enter(Phase phase, uint32_t now_ms) noexcept;
  void fail(Trouble trouble, uint32_t now_ms) noexcept;
  bool identify() noexcept;
  bool configure() noexcept;
  bool configured() noexcept;
  void sample(uint32_t now_ms) noexcept;
  void add(int32_t rate) noexcept;

  const mpu6050::Setup setup_;
  const Facing facing_;
  I2c& bus_;
  Troubles& troubles_;
  hal::GyroReading sums_{};
  uint32_t since_ms_ = 0;    // in this phase
  uint32_t sampled_ms_ = 0;  // the last time that a sample was there
  uint32_t looked_ms_ = 0;   // into the FIFO
  Phase phase_ = Phase::held;
};

}  // namespace whisker::hal::stm32f405

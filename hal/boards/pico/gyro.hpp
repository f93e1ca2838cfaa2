#pragma once

#include "hal/boards/common/mpu6050.hpp"
#include "hal/boards/common/shared.hpp"
#include "hal/boards/pico/i2c.hpp"
#include "hal/boards/pico/trouble.hpp"
#include "hal/gyro.hpp"

namespace whisker::hal::pico {

/// The gyro of an MPU-6050 on the sensors' bus, if the parameters say that one is fitted.
///
/// ```
/// off   held -> identify -> reset -> resetting -> clock .. scale -> settling -> verify -> fifo_off ..
/// fifo_on -> count <-> fetch
///         ^ |
///         +--------------------- did not start, silent, or lost samples: tried again
///         ----------------------------+
/// ```
/// Its FIFO keeps the samples of 5 s at 100 Hz. Where samples are lost, it does not answer until the chip is
/// started again: the core then counts the gyro as lost.
class Gyro final : public hal::Gyro {
 public:
  static constexpr uint32_t kHeldMs = 100;   ///< before the next try
  static constexpr uint32_t kPollMs = 4;     ///< between two looks into the FIFO
  static constexpr uint32_t kSilentMs = 60;  ///< without a sample for this long, the chip is started again

  /// While no handler runs.
  void adopt(const GyroParams& gyro, mcu::Facing facing = mcu::Facing::up) noexcept;
  bool read(hal::GyroReading& out) noexcept override;
  void collect(Troubles& troubles) noexcept;

  // In the handlers, by SensorBus.
  /// False: nothing to ask now.
  bool next(uint32_t now_ms, I2c::Transfer& transfer) noexcept;
  /// The transfer has ended well. True: it goes on at once.
  bool succeed(uint32_t now_ms, const I2c& bus) noexcept;
  void fail(uint32_t now_ms) noexcept;

 private:
  enum class Step : uint8_t {
    off,
    held,
    identify,
    reset,
    resetting,
    clock,
    divider,
    filter,
    scale,
    settling,
    verify,
    fifo_off,
    fifo_source,
    fifo_on,
    count,
    fetch,
  };
  struct Sums {
    hal::GyroReading reading{};
    bool samples = false;
  };
  void enter(Step step, uint32_t now_ms) noexcept;
  void start_again(mcu::Events& why, uint32_t now_ms) noexcept;
  void add(int32_t rate) noexcept;
  bool see_count(uint32_t now_ms, const I2c& bus) noexcept;
  void take(uint32_t now_ms, const I2c& bus) noexcept;

  mcu::mpu6050::Setup setup_;
  mcu::Facing facing_ = mcu::Facing::up;
  Step step_ = Step::off;
  uint32_t since_ms_ = 0;    // in this step
  uint32_t sampled_ms_ = 0;  // the last time that a sample was there
  uint8_t size_ = 0;         // bytes of the FIFO to fetch
  hal::GyroReading sums_{};
  mcu::Latest<Sums> published_;
  mcu::Events not_started_, silent_, lost_;
};

}  // namespace whisker::hal::pico

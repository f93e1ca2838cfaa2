#pragma once

#include "hal/boards/stm32f405/ranger_kind.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::hal::stm32f405 {

/// Three rangefinders of one kind on one bus. All start at the same address, so each has a reset line, and
/// they are started one after the other.
///
/// ```
/// held -> waking -> measuring        one at a time is waking
///   ^        |          |
///   +--------+----------+            did not start, failed or silent: held in reset, then tried again
/// ```
class I2cRangers final : public hal::Rangefinders {
 public:
  static constexpr uint8_t kFirstAddress = 0x30;  ///< left; front and right follow
  static constexpr uint32_t kHeldMs = 100;        ///< time in reset before the next try

  /// All must outlive it.
  I2cRangers(const RangerKind& kind, I2c& bus, Troubles& troubles) noexcept
      : kind_(kind), bus_(bus), troubles_(troubles) {}

  void start(uint32_t now_ms) noexcept;
  /// Serves one sensor per call, in turn, with a few transfers. Call it several times per tick.
  void poll(uint32_t now_ms) noexcept;

  bool read(hal::RangeReadings& out) noexcept override;
  bool measuring(int beam) const noexcept { return sensor_[beam].phase == Phase::measuring; }

 private:
  enum class Phase : uint8_t { held, waking, measuring };
  struct Sensor {
    Phase phase = Phase::held;
    uint32_t since_ms = 0;     // in this phase
    uint32_t measured_ms = 0;  // time of the last fetched measurement
    hal::RangeReading reading{0, hal::RangeStatus::stale, UINT8_MAX, 15};
  };
  void hold(uint8_t beam, uint32_t now_ms) noexcept;
  void wake(uint8_t beam, uint32_t now_ms) noexcept;
  void measure(uint8_t beam, uint32_t now_ms) noexcept;
  bool somebody_is_waking() const noexcept;

  const RangerKind& kind_;
  I2c& bus_;
  Troubles& troubles_;
  Sensor sensor_[hal::kBeams];
  uint8_t next_ = 0;
  uint32_t now_ms_ = 0;
};

}  // namespace whisker::hal::stm32f405

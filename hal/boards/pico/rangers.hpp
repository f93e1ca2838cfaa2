#pragma once

#include "hal/boards/common/shared.hpp"
#include "hal/boards/common/vl53l0x.hpp"
#include "hal/boards/pico/i2c.hpp"
#include "hal/boards/pico/trouble.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::hal::pico {

/// Three VL53L0X on one bus. All start at the same address, so each has a reset line, and one at a time is
/// moved to its own. Interrupts serve them, so a long tick delays no reading.
///
/// ```
/// held -> waking -> identify -> move -> clear -> begin -> ask -> fetch -> acknowledge -> ask ...
///   ^        |          |                                  |
///   +--------+----------+----------------------------------+   did not start, or silent: held, then tried
///   again
/// ```
class Rangers final : public Rangefinders {
 public:
  static constexpr uint8_t kFirstAddress = 0x30;  ///< left; front and right follow
  static constexpr uint32_t kHeldMs = 100;        ///< time in reset before the next try
  static constexpr uint32_t kWakeMs = 2;          ///< from the release of its reset until it answers
  static constexpr uint32_t kSilentMs = 200;      ///< without a measurement for this long, it is started anew
  static constexpr uint32_t kTransferMs = 3;      ///< the longest takes 0.4 ms

  /// Holds all in reset.
  void start(uint32_t now_ms) noexcept;
  bool read(RangeReadings& out) noexcept override;
  /// Adds what has failed since the last call.
  void collect(Troubles& troubles) noexcept;

  // In the handlers, by SensorBus.
  void on_millisecond() noexcept { now_ms_ = now_ms_ + 1; }
  /// False: nothing to ask this one now.
  bool next(uint8_t beam, I2c::Transfer& transfer) noexcept;
  /// The transfer has ended well. True: it goes on at once.
  bool succeed(uint8_t beam, const I2c& bus) noexcept;
  /// A sensor that measures is asked again until it has been silent for long; one that starts is held.
  void fail(uint8_t beam) noexcept;

 private:
  enum class Phase : uint8_t { held, waking, identify, move, clear, begin, ask, fetch, acknowledge };
  struct Sensor {
    Phase phase = Phase::held;
    uint32_t since_ms = 0;     // in this phase, if it is held or waking
    uint32_t measured_ms = 0;  // time of the last fetched measurement
    RangeReading reading{0, RangeStatus::stale, UINT8_MAX, 15};
  };
  struct Published {
    RangeReading reading{0, RangeStatus::stale, UINT8_MAX, 15};
    uint32_t measured_ms = 0;
  };
  static uint8_t address_of(uint8_t beam) noexcept { return static_cast<uint8_t>(kFirstAddress + beam); }
  void hold(uint8_t beam) noexcept;
  bool is_alone_awake() const noexcept;

  Sensor sensor_[kBeams];
  mcu::Latest<Published> published_[kBeams];
  mcu::Events not_started_, silent_;
  volatile uint32_t now_ms_ = 0;  // the handler of the millisecond counts
};

}  // namespace whisker::hal::pico

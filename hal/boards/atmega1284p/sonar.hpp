#pragma once

#include "hal/boards/atmega1284p/trouble.hpp"
#include "hal/boards/common/shared.hpp"
#include "hal/rangefinders.hpp"

namespace whisker::hal::atmega1284p {

/// Three HC-SR04 whose echoes share the capture pin of timer 1, fired in turn.
///
/// ```
/// quiet -> shot -> echo                    the next beam when the slot is over and the line is low
/// ```
/// An echo's length is the sound's way there and back. Where none comes back, the sensor ends it by itself
/// after 38 ms. That is all that it says of open ground, and of a target that is soft, small or slanted: it
/// is reported as clear, and proves as much as range_clear_m says.
class SonarRangers final : public Rangefinders {
 public:
  static constexpr uint8_t kSlotMs = 45;      ///< a beam's: so much until the next one fires
  static constexpr uint8_t kAnswerMs = 5;     ///< from the shot to the echo's begin
  static constexpr uint8_t kEndlessMs = 200;  ///< after which the line is no echo
  static constexpr uint16_t kNearestMm = 20;
  static constexpr uint16_t kFarthestMm = 2000;  ///< farther counts as clear

  explicit SonarRangers(Troubles& troubles) noexcept;
  void start(uint32_t now_ms) noexcept;
  /// Call it every millisecond or two: fires, and takes what has come. Waits 10 us for the shot.
  void poll(uint32_t now_ms) noexcept;

  bool read(RangeReadings& out) noexcept override;

  /// Timer 1's capture.
  void on_interrupt() noexcept;

 private:
  enum class Phase : uint8_t { quiet, shot, echo };
  struct Sensor {
    RangeReading reading;
    uint32_t fired_ms;  // the distance was true a few milliseconds later
  };
  void fire(uint32_t now_ms) noexcept;
  void wait(uint32_t now_ms) noexcept;
  void finish(RangeStatus status, uint16_t mm) noexcept;
  void fail(Trouble trouble) noexcept;

  Troubles& troubles_;
  mcu::Ring<uint16_t, 2> lengths_;  // of echoes, in timer counts
  uint16_t rise_ = 0;               // the interrupt's own
  mcu::Events begun_;
  uint32_t slot_ms_ = 0;
  uint32_t now_ms_ = 0;
  uint8_t beam_ = 0;
  Phase phase_ = Phase::quiet;
  Sensor sensor_[kBeams];
};

}  // namespace whisker::hal::atmega1284p

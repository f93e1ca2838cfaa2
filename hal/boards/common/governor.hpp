#pragma once

#include <stdint.h>

namespace whisker::hal::mcu {

/// One motor with gear and encoder, with calibrated values.
struct MotorParams {
  int16_t full_speed = 4000;        ///< rim speed at full duty, 0.1 mm/s; 100..32767
  int32_t counts_per_metre = 5000;  ///< of rim travel; 100..1000000
  uint8_t stiffness_per_s = 5;      ///< added speed per lag distance, 1/s
  int32_t most_lag = 100000;        ///< limit of the lag, 0.1 um; 0..1000000
};

/// Wheel speed controller: feed-forward duty plus a term for the distance by which the counts lag behind.
///
/// With a motor that follows its duty with a time constant T, the loop is damped for
/// stiffness <= 1 / (4 T): 5 per second suits the 50 ms of the reference robot.
class Governor {
 public:
  static constexpr int16_t kFullDuty = 32767;

  explicit Governor(const MotorParams& params) noexcept;

  /// wanted: rim speed, 0.1 mm/s. counted: counts since the last call. elapsed_ms: since then.
  /// Returns the duty, +-kFullDuty. For wanted 0, the duty is 0 at once, and the lag is reset.
  int16_t step(int16_t wanted, int16_t counted, uint8_t elapsed_ms) noexcept;

 private:
  MotorParams params_;
  int32_t way_per_count_;  // 0.1 um
  int32_t lag_ = 0;        // 0.1 um
  int16_t wanted_ = 0;     // of the last call
};

}  // namespace whisker::hal::mcu

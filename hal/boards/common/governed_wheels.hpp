#pragma once

#include "hal/boards/common/counts.hpp"
#include "hal/boards/common/governor.hpp"
#include "hal/clock.hpp"
#include "hal/drive.hpp"

namespace whisker::hal::mcu {

/// A drive of motors and encoders with a speed controller per wheel. It never refuses a command. `Motors`: a
/// class with drive(int16_t left, int16_t right), duties +-32767. `Encoders`: a class with bool
/// read(EncoderCounts&).
template <class Motors, class Encoders>
class GovernedWheels final : public Drive {
 public:
  /// All must outlive it.
  GovernedWheels(const MotorParams& left, const MotorParams& right, Motors& motors, Encoders& encoders,
                 Clock& clock) noexcept
      : motors_(motors), encoders_(encoders), clock_(clock), left_(left), right_(right) {}

  /// Other motors, while the wheels stand.
  void adopt(const MotorParams& left, const MotorParams& right) noexcept {
    left_ = Governor(left);
    right_ = Governor(right);
  }
  bool command(WheelSpeeds speeds) noexcept override {
    const uint32_t now = clock_.now_ms();
    const uint32_t elapsed = now - governed_ms_;
    const uint8_t ms = static_cast<uint8_t>(elapsed > UINT8_MAX ? UINT8_MAX : elapsed);
    // Without new counts, the wheels count as having followed, so no lag is added.
    EncoderCounts counts = governed_;
    const bool fresh = encoders_.read(counts);
    motors_.drive(left_.step(speeds.left, counts_between(governed_.left, counts.left), fresh ? ms : 0),
                  right_.step(speeds.right, counts_between(governed_.right, counts.right), fresh ? ms : 0));
    governed_ = counts;
    governed_ms_ = now;
    return true;
  }
  bool read(EncoderCounts& out) noexcept override { return encoders_.read(out); }

 private:
  Motors& motors_;
  Encoders& encoders_;
  Clock& clock_;
  Governor left_;
  Governor right_;
  EncoderCounts governed_{};
  uint32_t governed_ms_ = 0;
};

}  // namespace whisker::hal::mcu

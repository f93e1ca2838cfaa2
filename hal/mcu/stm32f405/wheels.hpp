#pragma once

#include "hal/clock.hpp"
#include "hal/drive.hpp"
#include "hal/mcu/common/governor.hpp"
#include "hal/mcu/stm32f405/encoders.hpp"
#include "hal/mcu/stm32f405/motors.hpp"

namespace whisker::hal::stm32f405 {

/// The drive: motors and encoders, with a governor for each wheel. Never refuses.
class Wheels final : public hal::Drive {
 public:
  /// The clock must outlive it.
  Wheels(const mcu::MotorParams& left, const mcu::MotorParams& right, hal::Clock& clock) noexcept
      : clock_(clock), left_(left), right_(right) {}

  void start(const Clocks& clocks) noexcept;
  bool command(hal::WheelSpeeds speeds) noexcept override;
  bool read(hal::EncoderCounts& out) noexcept override;

 private:
  hal::Clock& clock_;
  Motors motors_;
  Encoders encoders_;
  mcu::Governor left_;
  mcu::Governor right_;
  hal::EncoderCounts governed_{};
  uint32_t governed_ms_ = 0;
};

}  // namespace whisker::hal::stm32f405

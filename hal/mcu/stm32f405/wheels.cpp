#include "hal/mcu/stm32f405/wheels.hpp"

#include "hal/mcu/common/counts.hpp"

namespace whisker::hal::stm32f405 {

void Wheels::start(const Clocks& clocks) noexcept {
  motors_.start(clocks);
  encoders_.start();
  governed_ms_ = clock_.now_ms();
}

bool Wheels::command(hal::WheelSpeeds speeds) noexcept {
  const uint32_t now = clock_.now_ms();
  const uint32_t elapsed = now - governed_ms_;
  const uint8_t ms = static_cast<uint8_t>(elapsed > UINT8_MAX ? UINT8_MAX : elapsed);
  const hal::EncoderCounts counts = encoders_.read();
  motors_.drive(left_.step(speeds.left, mcu::counts_between(governed_.left, counts.left), ms),
                right_.step(speeds.right, mcu::counts_between(governed_.right, counts.right), ms));
  governed_ = counts;
  governed_ms_ = now;
  return true;
}

bool Wheels::read(hal::EncoderCounts& out) noexcept {
  out = encoders_.read();
  return true;
}

}  // namespace whisker::hal::stm32f405

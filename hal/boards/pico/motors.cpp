#include "hal/boards/pico/motors.hpp"

#include "hal/boards/pico/clock.hpp"
#include "hal/boards/pico/pins.hpp"
#include "hal/boards/pico/reg/pwm.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kSteps = kCoreHz / Motors::kPwmHz;
constexpr Address kLeft = base::kPwm;  // pins 16 and 17 are those of slice 0, 18 and 19 those of slice 1
constexpr Address kRight = base::kPwm + pwm::kCh1Csr.offset - pwm::kCh0Csr.offset;

/// One input stays high, and the other is low while the motor is driven.
void drive_one(Address slice, int16_t duty) noexcept {
  const uint32_t size = static_cast<uint32_t>(duty < 0 ? -int32_t{duty} : int32_t{duty});
  const uint32_t braked = kSteps - size * kSteps / INT16_MAX;
  const bool forward = duty >= 0;
  store(slice, pwm::kCh0Cc,
        bits(pwm::kA, forward ? kSteps : braked) | bits(pwm::kB, forward ? braked : kSteps));
}

void start_slice(Address slice) noexcept {
  store(slice, pwm::kCh0Div, bits(pwm::kInt, 1));
  store(slice, pwm::kCh0Top, kSteps - 1);
  drive_one(slice, 0);
  store(slice, pwm::kCh0Csr, mask(pwm::kEn));
}

}  // namespace

void Motors::start() noexcept {
  start_slice(kLeft);
  start_slice(kRight);
  for (const Gpio pin : wiring::kMotors) connect(pin, Function::pwm, Pull::down);
  write(wiring::kMotorsAwake, true);
}

void Motors::drive(int16_t left, int16_t right) noexcept {
  drive_one(kLeft, left);
  drive_one(kRight, right);
}

void Motors::cut_off() noexcept {
  write(wiring::kMotorsAwake, false);
  for (const Gpio pin : wiring::kMotors) {
    write(pin, false);
    connect(pin, Function::sio, Pull::down);
  }
}

}  // namespace whisker::hal::pico

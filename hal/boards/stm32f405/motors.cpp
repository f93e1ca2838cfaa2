#include "hal/boards/stm32f405/motors.hpp"

#include "hal/boards/stm32f405/pins.hpp"
#include "hal/boards/stm32f405/reg/tim.hpp"

namespace whisker::hal::stm32f405 {
namespace {

constexpr uint32_t kHighWhileBelow = 6;  // PWM mode 1
constexpr Address kBase = base::kTim1;

}  // namespace

void Motors::start(const Clocks& clocks) noexcept {
  steps_ = clocks.timer1_hz / kPwmHz;
  store(kBase, tim::kPsc, 0);
  store(kBase, tim::kArr, steps_ - 1);
  store(kBase, tim::kCcr1, 0);
  store(kBase, tim::kCcr2, 0);
  set(kBase, tim::kOc1m, kHighWhileBelow);
  set(kBase, tim::kOc2m, kHighWhileBelow);
  set(kBase, tim::kOc1pe, 1);
  set(kBase, tim::kOc2pe, 1);
  set(kBase, tim::kCc1e, 1);
  set(kBase, tim::kCc2e, 1);
  set(kBase, tim::kArpe, 1);
  store(kBase, tim::kEgr, bits(tim::kUg, 1));
  set(kBase, tim::kMoe, 1);
  set(kBase, tim::kCen, 1);
  drive(0, 0);
}

void Motors::cut_off() noexcept {
  for (const Pin& direction : wiring::kDirections) write(direction, false);
  store(kBase, tim::kCcr1, 0);
  store(kBase, tim::kCcr2, 0);
}

void Motors::drive(int16_t left, int16_t right) noexcept {
  drive_one(0, left);
  drive_one(1, right);
}

void Motors::drive_one(uint8_t wheel, int16_t duty) noexcept {
  const uint32_t size = static_cast<uint32_t>(duty < 0 ? -int32_t{duty} : int32_t{duty});
  const uint32_t high = size >= INT16_MAX ? steps_ : size * steps_ / INT16_MAX;
  const Pin* direction = &wiring::kDirections[2 * wheel];
  // The low input changes first, so that both inputs are never high.
  write(direction[duty > 0 ? 1 : 0], false);
  store(kBase, wheel == 0 ? tim::kCcr1 : tim::kCcr2, high);
  if (duty != 0) {
    write(direction[duty > 0 ? 0 : 1], true);
  } else {
    write(direction[1], false);
  }
}

}  // namespace whisker::hal::stm32f405

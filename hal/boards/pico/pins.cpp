#include "hal/boards/pico/pins.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/pico/reg/io_bank0.hpp"
#include "hal/boards/pico/reg/pads.hpp"
#include "hal/boards/pico/reg/resets.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint16_t kControlStride = 8;
constexpr uint16_t kPadStride = 4;
constexpr uint32_t kWakePolls = 10000;

constexpr Register nth(Register first, Gpio pin, uint16_t stride) noexcept {
  return {static_cast<uint16_t>(first.offset + pin * stride)};
}

}  // namespace

void connect(Gpio pin, Function function, Pull pull) noexcept {
  store(base::kPadsBank0, nth(pads::kGpio0, pin, kPadStride),
        mask(pads::kIe) | mask(pads::kSchmitt) | bits(pads::kPue, pull == Pull::up ? 1 : 0) |
            bits(pads::kPde, pull == Pull::down ? 1 : 0));
  store(base::kIoBank0, nth(io_bank0::kGpio0Ctrl, pin, kControlStride),
        bits(io_bank0::kFuncsel, static_cast<uint32_t>(function)));
}

// The level is set before the direction, so that the pin never outputs the wrong one.
void make_output(Gpio pin, bool high) noexcept {
  write(pin, high);
  drive(pin, true);
  connect(pin, Function::sio, Pull::down);
}

bool wake_peripherals() noexcept {
  constexpr uint32_t kUsed = mask(resets::kIoBank0) | mask(resets::kPadsBank0) | mask(resets::kTimer) |
                             mask(resets::kUart0) | mask(resets::kI2c0) | mask(resets::kPwm) |
                             mask(resets::kPio0) | mask(resets::kPllSys) | mask(resets::kPllUsb) |
                             mask(resets::kUsbctrl);
  clear_bits(base::kResets, resets::kReset, kUsed);
  for (Patience patience(kWakePolls); (load(base::kResets, resets::kResetDone) & kUsed) != kUsed;) {
    if (!patience.spend()) return false;
  }
  return true;
}

void set_up_pins() noexcept {
  using namespace wiring;
  make_output(kMotorsAwake, false);
  for (const Gpio pin : kMotors) make_output(pin, false);
  for (const Gpio pin : kAwake) make_output(pin, false);
  make_output(kLed, false);
  make_output(kTick, false);
  for (const Gpio pin : kEncoders) connect(pin, Function::pio0, Pull::up);
  for (const Gpio pin : kEchoes) connect(pin, Function::sio, Pull::down);
  for (const Gpio pin : kBumpers) connect(pin, Function::sio, Pull::up);
  connect(kButton, Function::sio, Pull::up);
  connect(kI2cData, Function::i2c, Pull::up);
  connect(kI2cClock, Function::i2c, Pull::up);
  connect(kLineOut, Function::uart, Pull::none);
  connect(kLineIn, Function::uart, Pull::up);
}

}  // namespace whisker::hal::pico

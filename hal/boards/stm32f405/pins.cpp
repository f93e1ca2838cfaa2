#include "hal/boards/stm32f405/pins.hpp"

#include "hal/boards/stm32f405/reg/gpio.hpp"
#include "hal/boards/stm32f405/reg/rcc.hpp"

namespace whisker::hal::stm32f405 {
namespace {

enum Mode : uint32_t { kInput = 0, kOutput = 1, kFunction = 2, kAnalogue = 3 };
enum Pull : uint32_t { kNone = 0, kUp = 1 };
constexpr uint32_t kMediumSpeed = 1;

void configure(Pin pin, Mode mode, bool open_drain, Pull pull) noexcept {
  set(pin.port, of_pin(gpio::kOtyper, pin.number), open_drain ? 1 : 0);
  set(pin.port, of_pin(gpio::kOspeedr, pin.number), kMediumSpeed);
  set(pin.port, of_pin(gpio::kPupdr, pin.number), pull);
  set(pin.port, of_pin(gpio::kModer, pin.number), mode);
}

void connect(Pin pin, Function function, bool open_drain, Pull pull) noexcept {
  const PinField alternate = pin.number < gpio::kAfrh.first ? gpio::kAfrl : gpio::kAfrh;
  set(pin.port, of_pin(alternate, pin.number), static_cast<uint32_t>(function));
  configure(pin, kFunction, open_drain, pull);
}

}  // namespace

// A pin's level is set before its direction, so that it never outputs the wrong level.
void make_output(Pin pin, bool high) noexcept {
  write(pin, high);
  configure(pin, kOutput, false, kNone);
}

void make_open_drain(Pin pin, bool high) noexcept {
  write(pin, high);
  configure(pin, kOutput, true, kUp);
}

void make_input_pulled_up(Pin pin) noexcept { configure(pin, kInput, false, kUp); }

void make_analogue(Pin pin) noexcept { configure(pin, kAnalogue, false, kNone); }

void make_function(Pin pin, Function function) noexcept { connect(pin, function, false, kNone); }

void make_shared_line(Pin pin, Function function) noexcept { connect(pin, function, true, kUp); }

void make_function_pulled_up(Pin pin, Function function) noexcept { connect(pin, function, false, kUp); }

void write(Pin pin, bool high) noexcept {
  const uint32_t bit = bits(of_pin(gpio::kBs, pin.number), 1);
  store(pin.port, gpio::kBsrr, high ? bit : bit << 16);
}

bool read(Pin pin) noexcept { return is_set(pin.port, of_pin(gpio::kIdr, pin.number)); }

void power_peripherals() noexcept {
  static constexpr Field kUsed[] = {rcc::kGpioaen, rcc::kGpioben, rcc::kGpiocen, rcc::kTim1en,
                                    rcc::kTim2en,  rcc::kTim3en,  rcc::kTim4en,  rcc::kUsart2en,
                                    rcc::kI2c1en,  rcc::kCan1en,  rcc::kAdc1en,  rcc::kRngen};
  for (const Field enable : kUsed) set(base::kRcc, enable, 1);
}

void set_up_pins() noexcept {
  using namespace wiring;
  for (const Pin pin : kDirections) make_output(pin, false);
  make_function(kPwmLeft, Function::tim1);
  make_function(kPwmRight, Function::tim1);
  for (const Pin pin : kEncoders) make_function_pulled_up(pin, Function::tim3_tim4);
  make_function(kConsoleOut, Function::usart);
  make_function_pulled_up(kConsoleIn, Function::usart);
  make_shared_line(kI2cClock, Function::i2c);
  make_shared_line(kI2cData, Function::i2c);
  for (const Pin pin : kRangerAwake) make_output(pin, false);
  for (const Pin pin : kInfrared) make_analogue(pin);
  for (const Pin pin : kBumpers) make_input_pulled_up(pin);
  make_input_pulled_up(kButton);
  make_function(kCanOut, Function::can);
  make_function_pulled_up(kCanIn, Function::can);
}

}  // namespace whisker::hal::stm32f405

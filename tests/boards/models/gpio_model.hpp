#pragma once

#include <functional>

#include "hal/boards/stm32f405/reg/gpio.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

/// A port: outputs drive their pins, and the outside may hold a pin low.
class GpioModel : public Peripheral {
 public:
  enum Mode : std::uint32_t { kInput = 0, kOutput = 1, kFunction = 2, kAnalogue = 3 };

  std::uint32_t load(std::uint32_t offset) override {
    if (offset != of_pin(gpio::kIdr, 0).offset) return word(offset);
    std::uint32_t levels = 0;
    for (std::uint8_t pin = 0; pin < 16; ++pin) levels |= (level(pin) ? 1U : 0U) << pin;
    return levels;
  }
  void store(std::uint32_t offset, std::uint32_t value) override {
    if (offset != gpio::kBsrr.offset) {
      word(offset) = value;
      return;
    }
    const std::uint32_t before = driven_;
    driven_ = (driven_ & ~(value >> 16)) | (value & 0xFFFF);
    for (std::uint8_t pin = 0; pin < 16; ++pin) {
      if (((driven_ & ~before) >> pin & 1U) != 0 && on_rise) on_rise(pin);
    }
  }

  Mode mode(std::uint8_t pin) { return static_cast<Mode>(get(of_pin(gpio::kModer, pin))); }
  bool open_drain(std::uint8_t pin) { return get(of_pin(gpio::kOtyper, pin)) != 0; }
  bool pulled_up(std::uint8_t pin) { return get(of_pin(gpio::kPupdr, pin)) == 1; }
  std::uint32_t function(std::uint8_t pin) { return get(of_pin(pin < 8 ? gpio::kAfrl : gpio::kAfrh, pin)); }
  /// The level that the port drives as an output.
  bool output(std::uint8_t pin) { return mode(pin) == kOutput && (driven_ >> pin & 1U) != 0; }
  bool level(std::uint8_t pin) {
    if (held_low && held_low(pin)) return false;
    return mode(pin) != kOutput || output(pin);
  }

  std::function<bool(std::uint8_t)> held_low;
  std::function<void(std::uint8_t)> on_rise;

 private:
  std::uint32_t driven_ = 0;
};

}  // namespace whisker::hal::stm32f405::model

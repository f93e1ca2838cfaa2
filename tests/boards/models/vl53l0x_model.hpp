#pragma once

#include <cstdint>

#include "hal/boards/stm32f405/vl53l0x.hpp"
#include "tests/boards/models/i2c_model.hpp"

namespace whisker::hal::stm32f405::model {

/// A time-of-flight sensor: off while its reset is held, then at its default address until readdressed.
class Vl53l0xModel : public I2cDevice {
 public:
  bool answers(std::uint8_t address) override { return awake && !dead && address == address_; }
  void begin(bool reading) override { first_ = !reading; }
  bool write(std::uint8_t byte) override {
    if (first_) {
      index_ = byte;
      first_ = false;
      return true;
    }
    if (index_ == vl53l0x::kAddress) address_ = byte & 0x7F;
    if (index_ == vl53l0x::kStart) measuring = byte == vl53l0x::kBackToBack;
    if (index_ == vl53l0x::kInterruptClear) ready_ = false;
    ++index_;
    return true;
  }
  std::uint8_t read() override {
    const std::uint8_t i = index_++;
    if (i == vl53l0x::kModel) return model;
    if (i == vl53l0x::kInterruptStatus) return ready_ ? 0x04 : 0x00;
    if (i == vl53l0x::kRangeStatus) return static_cast<std::uint8_t>(status << 3);
    if (i == vl53l0x::kRangeStatus + 10) return static_cast<std::uint8_t>(mm >> 8);
    if (i == vl53l0x::kRangeStatus + 11) return static_cast<std::uint8_t>(mm);
    return 0x5A;
  }
  void reset_line(bool high) {
    if (high && !awake) {
      address_ = vl53l0x::kDefaultAddress;
      measuring = false;
      ready_ = false;
    }
    awake = high;
  }
  void measure(std::uint16_t distance_mm, std::uint8_t how = vl53l0x::kValid) {
    if (!awake || !measuring || dead) return;
    mm = distance_mm;
    status = how;
    ready_ = true;
  }
  std::uint8_t address() const { return address_; }

  bool awake = false;
  bool dead = false;
  bool measuring = false;
  std::uint8_t model = vl53l0x::kModelValue;
  std::uint16_t mm = 0;
  std::uint8_t status = 0;

 private:
  std::uint8_t address_ = vl53l0x::kDefaultAddress;
  std::uint8_t index_ = 0;
  bool first_ = false;
  bool ready_ = false;
};

}  // namespace whisker::hal::stm32f405::model

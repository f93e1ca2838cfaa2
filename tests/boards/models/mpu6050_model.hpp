#pragma once

#include <cstdint>
#include <deque>
#include <functional>

#include "hal/boards/stm32f405/mpu6050.hpp"
#include "tests/boards/models/i2c_model.hpp"

namespace whisker::hal::stm32f405::model {

/// The registers that the driver uses, and the FIFO, after the register map. Asleep after power-on.
class Mpu6050Model : public I2cDevice {
 public:
  Mpu6050Model() { power_on(); }

  bool answers(std::uint8_t address) override { return !dead && address == mpu6050::kAddress; }
  void begin(bool reading) override {
    first_ = !reading;
    if (reading && index_ == mpu6050::kFifo && on_fifo_read) on_fifo_read();
  }
  bool write(std::uint8_t byte) override {
    if (first_) {
      index_ = byte;
      first_ = false;
      return true;
    }
    if (index_ == mpu6050::kPower && (byte & mpu6050::kReset) != 0) {
      power_on();
      resetting_ms_ = 50;
      ++resets;
    } else if (resetting_ms_ == 0 && index_ != deaf_register) {
      reg[index_] = byte;
      const bool empties = index_ == mpu6050::kUserControl && byte == mpu6050::kFifoOff;
      if (empties) fifo.clear();
    }
    ++index_;
    return true;
  }
  std::uint8_t read() override {
    if (index_ == mpu6050::kFifo) return take();
    const std::uint8_t i = index_++;
    if (i == mpu6050::kWhoAmI) return identity;
    if (i == mpu6050::kFifoCount) count_ = static_cast<std::uint16_t>(fifo.size());
    if (i == mpu6050::kFifoCount) return static_cast<std::uint8_t>(count_ >> 8);
    if (i == mpu6050::kFifoCount + 1) return static_cast<std::uint8_t>(count_);
    return reg[i];
  }

  /// A millisecond at this rate about z, in units of the full scale / 32768.
  void pass(int rate) {
    if (resetting_ms_ > 0) --resetting_ms_;
    const bool awake = (reg[mpu6050::kPower] & 0xC0) == 0;
    const bool filtered = reg[mpu6050::kConfig] % 8 >= 1 && reg[mpu6050::kConfig] % 8 <= 6;
    if (dead || !awake || !filtered || ++clock_ <= reg[mpu6050::kSampleRateDivider]) return;
    clock_ = 0;
    if (reg[mpu6050::kFifoEnable] != mpu6050::kRateToFifo || reg[mpu6050::kUserControl] != mpu6050::kFifoOn)
      return;
    fifo.push_back(static_cast<std::uint8_t>(rate >> 8));
    fifo.push_back(static_cast<std::uint8_t>(rate));
    ++samples;
    while (fifo.size() > mpu6050::kFifoBytes) fifo.pop_front();
  }
  void power_on() {
    for (std::uint8_t& r : reg) r = 0;
    reg[mpu6050::kPower] = 0x40;
    fifo.clear();
  }

  std::uint8_t reg[256] = {};
  std::deque<std::uint8_t> fifo;
  std::function<void()> on_fifo_read;
  bool dead = false;
  std::uint8_t identity = mpu6050::kIdentity;
  int deaf_register = -1;  // does not take what is written
  int resets = 0;
  int samples = 0;  // into the FIFO

 private:
  std::uint8_t take() {
    if (fifo.empty()) return last_;
    last_ = fifo.front();
    fifo.pop_front();
    return last_;
  }

  std::uint8_t index_ = 0;
  bool first_ = false;
  std::uint16_t count_ = 0;
  std::uint8_t last_ = 0;
  int clock_ = 0;
  int resetting_ms_ = 0;
};

}  // namespace whisker::hal::stm32f405::model

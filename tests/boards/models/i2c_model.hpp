#pragma once

#include <cstdint>
#include <vector>

#include "hal/boards/stm32f405/reg/i2c.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

/// A device on the bus.
class I2cDevice {
 public:
  virtual ~I2cDevice() = default;
  virtual bool answers(std::uint8_t address) = 0;
  virtual void begin(bool reading) = 0;
  /// False: the device refuses the byte.
  virtual bool write(std::uint8_t byte) = 0;
  virtual std::uint8_t read() = 0;
  virtual void stop() {}
};

/// I2C1 as a master, after the reference manual: flags, clock stretching until data is read, and the time at
/// which acknowledgement is decided.
class I2cModel : public Peripheral {
 public:
  static constexpr int kBit = 5;  // polls

  std::uint32_t load(std::uint32_t offset) override;
  void store(std::uint32_t offset, std::uint32_t value) override;
  void advance() override;

  void attach(I2cDevice& device) { devices_.push_back(&device); }
  bool set_up_for_400khz(double mhz);
  /// Superfluous bytes that were clocked in because the end of a read came too late.
  int unwanted_bytes = 0;
  int stops = 0;

  enum class Fault { none, deaf, arbitration, bus_error, clock_held };
  Fault fault = Fault::none;
  bool line_held = false;  // by another device: the bus is busy, and no start succeeds

 private:
  enum class Phase { idle, starting, addressing, address_flag, writing, reading, halted };
  void begin_start();
  void end_byte();
  void end_address();
  void end_write();
  void end_read();
  void stop();
  void reset();

  std::vector<I2cDevice*> devices_;
  I2cDevice* device_ = nullptr;
  Phase phase_ = Phase::idle;
  bool reading_ = false;
  bool shifting_ = false;
  bool shift_full_ = false;
  bool data_full_ = false;
  bool status_read_ = false;
  bool ack_next_ = false;
  std::uint8_t shift_ = 0;
  int left_ = 0;
};

}  // namespace whisker::hal::stm32f405::model

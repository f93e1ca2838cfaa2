#pragma once

#include <stdint.h>

#include "hal/boards/common/patience.hpp"
#include "hal/boards/stm32f405/clock.hpp"
#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405 {

/// I2C1 as the only master, 400 kHz. A transfer blocks for at least kTransferUs and at most about four times
/// as long. Every failure is counted by name. Afterwards the bus is free, unless another device still holds
/// it.
class I2c {
 public:
  static constexpr uint32_t kTransferUs = 1000;
  static constexpr uint8_t kLongest = 32;  ///< bytes in one direction

  void start(const Clocks& clocks, Troubles& troubles) noexcept;

  /// Writes `out`, then reads `in`, to and from a 7-bit address; either may be empty. False: the failure was
  /// counted; `in` is invalid.
  bool transfer(uint8_t address, const uint8_t* out, uint8_t out_size, uint8_t* in, uint8_t in_size) noexcept;

  /// Writes one byte to a register.
  bool write(uint8_t address, uint8_t reg, uint8_t byte) noexcept;
  /// Reads from a register and those that follow it.
  bool read(uint8_t address, uint8_t reg, uint8_t* in, uint8_t in_size) noexcept;

 private:
  enum class Step : uint8_t { done, failed, timed_out };

  void configure() noexcept;
  bool take_bus() noexcept;
  void free_bus() noexcept;
  Step wait(Field event, Patience& patience) noexcept;
  Step address(uint8_t byte, Patience& patience) noexcept;
  Step send(uint8_t address_byte, const uint8_t* out, uint8_t size, Patience& patience) noexcept;
  Step receive(uint8_t address_byte, uint8_t* in, uint8_t size, Patience& patience) noexcept;
  bool finish(Step step) noexcept;
  Patience patience(uint32_t us) const noexcept { return Patience::for_us(us, clocks_.core_hz); }

  Clocks clocks_ = kInternalClocks;
  Troubles* troubles_ = nullptr;
};

}  // namespace whisker::hal::stm32f405

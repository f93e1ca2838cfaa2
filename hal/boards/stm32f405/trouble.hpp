/// Failures of this board: each cause has a name and a counter.
#pragma once

#include "hal/boards/common/tally.hpp"

namespace whisker::hal::stm32f405 {

enum class Trouble : uint8_t {
  crystal_not_ready,     ///< the crystal did not start; the internal oscillator is used
  pll_not_locked,        ///< the clock stays at 16 MHz
  clock_not_switched,    ///< the core stayed on the internal oscillator
  watchdog_not_ready,    ///< it did not accept its period in time; it may run with its default
  usart_receive_lost,    ///< bytes arrived faster than they were read, or damaged
  i2c_nack,              ///< no device answered to the address, or a byte was refused
  i2c_bus_stuck,         ///< a device held the bus; the clock was toggled to free it
  i2c_arbitration_lost,  ///< another master, or a line that stays low
  i2c_bus_error,         ///< a start or stop condition within a byte
  i2c_timeout,           ///< the transfer did not end in time
  ranger_not_started,    ///< a rangefinder did not give the answer of its kind
  ranger_silent,         ///< a rangefinder stopped measuring and was reset
  gyro_not_started,  ///< the gyro did not give the answer of its kind, or does not have the rate or the range
  gyro_silent,       ///< the gyro stopped measuring and was reset
  gyro_samples_lost,  ///< samples of the gyro were lost, and it was reset
  adc_no_conversion,  ///< a conversion did not end in time
  random_not_ready,   ///< the generator of random numbers gave none
};
constexpr uint8_t kTroubles = 17;

/// In snake case; never nullptr.
const char* name(Trouble trouble) noexcept;

using Troubles = mcu::Tally<Trouble, kTroubles>;

}  // namespace whisker::hal::stm32f405

#include "hal/boards/stm32f405/trouble.hpp"

namespace whisker::hal::stm32f405 {

const char* name(Trouble trouble) noexcept {
  switch (trouble) {
    case Trouble::crystal_not_ready: return "crystal_not_ready";
    case Trouble::pll_not_locked: return "pll_not_locked";
    case Trouble::clock_not_switched: return "clock_not_switched";
    case Trouble::watchdog_not_ready: return "watchdog_not_ready";
    case Trouble::usart_receive_lost: return "usart_receive_lost";
    case Trouble::i2c_nack: return "i2c_nack";
    case Trouble::i2c_bus_stuck: return "i2c_bus_stuck";
    case Trouble::i2c_arbitration_lost: return "i2c_arbitration_lost";
    case Trouble::i2c_bus_error: return "i2c_bus_error";
    case Trouble::i2c_timeout: return "i2c_timeout";
    case Trouble::ranger_not_started: return "ranger_not_started";
    case Trouble::ranger_silent: return "ranger_silent";
    case Trouble::gyro_not_started: return "gyro_not_started";
    case Trouble::gyro_silent: return "gyro_silent";
    case Trouble::gyro_samples_lost: return "gyro_samples_lost";
    case Trouble::adc_no_conversion: return "adc_no_conversion";
    case Trouble::random_not_ready: return "random_not_ready";
  }
  return "unknown";
}

}  // namespace whisker::hal::stm32f405

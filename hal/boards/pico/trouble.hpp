/// Failures of this board: each cause has a name and a counter.
#pragma once

#include "hal/boards/common/tally.hpp"

namespace whisker::hal::pico {

enum class Trouble : uint8_t {
  crystal_not_ready,   ///< the crystal did not start: nothing drives
  image_damaged,       ///< the sum over the program is wrong: nothing drives
  line_bytes_lost,     ///< bytes of the serial line came faster than they were read
  usb_no_clock,        ///< the clock of the USB did not start: only the serial line talks
  usb_not_read,        ///< bytes for the USB had no room: the host does not read, and frames for it expire
  i2c_no_answer,       ///< no device answered to the address, or a byte was refused
  i2c_timeout,         ///< a transfer did not end in time: the bus was freed by nine clocks
  ranger_not_started,  ///< a rangefinder did not give the answer of its kind
  ranger_silent,       ///< a rangefinder stopped measuring and was reset
  gyro_not_started,  ///< the gyro did not give the answer of its kind, or does not have the rate or the range
  gyro_silent,       ///< the gyro stopped measuring and was reset
  gyro_samples_lost,  ///< samples of the gyro were lost, and it was reset
  counts_not_ready,   ///< the encoders' state machine did not answer
};
constexpr uint8_t kTroubles = 13;

using Troubles = mcu::Tally<Trouble, kTroubles>;

}  // namespace whisker::hal::pico

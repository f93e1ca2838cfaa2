#pragma once

#include "hal/boards/common/tally.hpp"

namespace whisker::hal::atmega1284p {

/// What goes wrong on this board.
enum class Trouble : uint8_t {
  echo_line_high,     ///< the line of the echoes was high before the shot: no shot
  echo_missing,       ///< the sensor did not answer the shot
  echo_endless,       ///< its echo did not end in time
  adc_no_conversion,  ///< a conversion did not end in time
  encoder_skipped,    ///< both inputs of a wheel changed at once: a count was lost
  missed_ticks,       ///< the loop came too late for a whole period
};
constexpr uint8_t kTroubles = 6;

using Troubles = mcu::Tally<Trouble, kTroubles>;

}  // namespace whisker::hal::atmega1284p

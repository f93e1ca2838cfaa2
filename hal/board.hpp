/// What every board gives to a program. One board is linked; its folder has the rest.
#pragma once

#include "hal/byte_line.hpp"
#include "hal/byte_stream.hpp"
#include "hal/clock.hpp"
#include "hal/console.hpp"
#include "hal/meter.hpp"

namespace whisker::hal {

struct Board {
  Clock& clock;
  Console& console;    ///< on the UART
  ByteStream& serial;  ///< the same UART, for a companion instead of a person
  ByteLine* line;      ///< the same UART again, without waiting; null where it can only be waited for
  ByteStream& host;    ///< to the emulator's own input and output: many times faster than the UART
  Meter& meter;
};

/// The board, ready: the same one at every call. The one that is linked defines it, and leave().
const Board& board() noexcept;

/// Ends the emulator with this status. On hardware without one: stands still.
[[noreturn]] void leave(int status) noexcept;

}  // namespace whisker::hal

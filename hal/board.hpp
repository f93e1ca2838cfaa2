/// Interface of a board. A program links one board; the board's folder implements it.
#pragma once

#include "hal/byte_line.hpp"
#include "hal/byte_stream.hpp"
#include "hal/clock.hpp"
#include "hal/console.hpp"
#include "hal/meter.hpp"

namespace whisker::hal {

struct Board {
  Clock& clock;
  Console& console;  ///< on the UART
  ByteLine* line;    ///< the same UART, non-blocking; null if it only supports blocking access
  ByteStream& host;  ///< standard input and output of the emulator: many times faster than the UART
  Meter& meter;
};

/// The initialized board; every call returns the same one. The linked board defines this function and
/// leave().
const Board& board() noexcept;

/// Ends the emulator with this status. On hardware, it never returns.
[[noreturn]] void leave(int status) noexcept;

}  // namespace whisker::hal

/// What the programs share whose node of a CAN bus is behind the board's UART.
#pragma once

#include <stdint.h>

#include "firmware/can/node.hpp"
#include "firmware/fuzzy/digest.hpp"
#include "firmware/fuzzy/engine.hpp"
#include "firmware/version.hpp"
#include "hal/board.hpp"

namespace whisker::can_app {

/// Robot 1, with the table of the core. Waits for the first byte of the other end: between two starts, only
/// its instant differs, which makes the boot number.
inline can::Identity identity_behind_line(const hal::Board& board) noexcept {
  uint8_t byte = 0;
  while (board.line->take(&byte, 1) == 0) {
  }
  const uint32_t instant = board.meter.stamp();
  const auto boot = static_cast<uint16_t>(instant ^ instant >> 16);
  return {1, boot, kVersionNumber, fuzzy::digest(fuzzy::kDefaultTable)};
}

}  // namespace whisker::can_app

/// A CAN frame as a line of the LAWICEL protocol, "SLCAN": t (base) or T (extended), r and R for remote
/// frames; the identifier in 3 or 8 hexadecimal digits, the size in one, the bytes in two each. Lines end
/// with a carriage return, which is not included here. Source: LAWICEL AB, CAN232 manual.
#pragma once

#include "hal/can_port.hpp"

namespace whisker::hal::slcan {

constexpr uint8_t kTimeStamp = 4;  ///< digits
constexpr uint8_t kLongestLine = 1 + 8 + 1 + 2 * 8 + kTimeStamp;
constexpr uint8_t kEnd = '\r';

/// Returns the length of the line, without a time stamp. frame: well-formed; to: room for kLongestLine.
uint8_t write_line(const CanFrame& frame, uint8_t* to) noexcept;

/// False: not a frame; `out` is unchanged. Digits of either case; only a time stamp may follow, which is
/// ignored.
bool read_line(const uint8_t* line, uint8_t size, CanFrame& out) noexcept;

}  // namespace whisker::hal::slcan

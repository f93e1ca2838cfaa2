/// Logs in the format of `candump -L`: (seconds.micros) interface ID#DATA, one line per frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hal/can_port.hpp"

namespace whisker::hil {

struct LogFrame {
  std::uint64_t time_us = 0;
  std::string interface;
  hal::CanFrame frame{};
};

/// Without a newline.
std::string log_line(const LogFrame& entry);
/// std::nullopt: not a line of a log. Error frames and CAN FD frames are not accepted.
std::optional<LogFrame> parse_log_line(std::string_view line);

}  // namespace whisker::hil

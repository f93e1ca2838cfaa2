/// Logs in the format of `candump -L`: (seconds.micros) interface ID#DATA, one line per frame.
#pragma once

#include <cstdint>
#include <cstdio>
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

/// Writes received frames to a log, complete lines only, so that a failed run leaves a usable log.
class Recorder {
 public:
  /// file: "" for none, "-" for standard output. interface: name of the bus in the log. Throws
  /// std::runtime_error.
  Recorder(const std::string& file, const std::string& interface);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void write(const hal::CanFrame& frame);
  /// Throws std::runtime_error if not everything could be written.
  void close();

 private:
  std::string name_;
  std::string interface_;
  std::FILE* file_ = nullptr;
};

}  // namespace whisker::hil

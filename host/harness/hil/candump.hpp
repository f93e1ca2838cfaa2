/// Logs in the format of `candump -L`: (seconds.micros) interface ID#DATA, one line per frame.
#pragma once

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <string_view>

#include "hal/can_port.hpp"
#include "host/harness/file/file.hpp"

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

/// Writes received frames to a log as files::Growing does, so that also a failed run leaves a usable log:
/// FILE, or FILE.part if FILE had content.
class Recorder {
 public:
  /// file: "" for none, "-" for standard output. interface: name of the bus in the log. Throws
  /// std::runtime_error, also if FILE.part is there.
  Recorder(const std::string& file, const std::string& interface);

  void write(const hal::CanFrame& frame);
  /// Throws std::runtime_error if not everything could be written.
  void close();
  /// After a run that did not end: replaces no earlier log. Says where the frames are: "; the frames are in
  /// FILE".
  std::string keep();

 private:
  std::string name_;
  std::string interface_;
  std::optional<files::Growing> file_;
  std::exception_ptr lost_;  ///< the first error; nothing is written after it
};

}  // namespace whisker::hil

/// Logs in the format of `candump -L`: (seconds.micros) interface ID#DATA, one line per frame. Other logs of
/// candump and of python-can are read, too.
#pragma once

#include <cstdint>
#include <exception>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "hal/can_port.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/csv.hpp"

namespace whisker::hil {

struct LogFrame {
  std::uint64_t time_us = 0;
  std::string interface;
  hal::CanFrame frame{};
  const char* foreign = nullptr;  ///< what the frame is, if not one that a robot's bus can have
};

/// Without a newline.
std::string log_line(const LogFrame& entry);
/// std::nullopt: not a line of a log. Also reads `candump` without -L, with -8, -e and -x.
std::optional<LogFrame> parse_log_line(std::string_view line);

/// The frames of a log that a robot's bus can have: data of classic CAN with 11 bits.
class LogReader {
 public:
  /// `name` is the name of the file in messages.
  LogReader(std::istream& in, const std::string& name) : lines_(in, name) {}

  /// False at the end. Throws InputError for a line that is not from a log; only the last one may be
  /// truncated, as a terminated recorder leaves it.
  bool next(LogFrame& frame);
  std::size_t line() const { return lines_.number(); }
  /// Number of the last line if it is truncated and therefore ignored. 0: it is complete.
  std::size_t cut() const { return cut_; }
  /// How many frames of other kinds there were: "error", "CAN FD", "remote", "29-bit".
  std::map<std::string, std::uint64_t>& skipped() { return skipped_; }

 private:
  LineReader lines_;
  std::size_t cut_ = 0;
  std::map<std::string, std::uint64_t> skipped_;
};

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

#pragma once

#include <cstdio>
#include <string>

#include "hal/can_port.hpp"

namespace whisker::hil {

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

#pragma once

#include <cstdio>
#include <string>

#include "hal/can_port.hpp"

namespace whisker::hil {

/// Writes frames into a log as they come, whole lines only, so that a run that ends badly leaves its log.
class Recorder {
 public:
  /// file: "" for none, "-" for standard output. interface: the name that the log gives the bus. Throws
  /// std::runtime_error.
  Recorder(const std::string& file, const std::string& interface);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void write(const hal::CanFrame& frame);
  /// Throws std::runtime_error if not all could be written.
  void close();

 private:
  std::string name_;
  std::string interface_;
  std::FILE* file_ = nullptr;
};

}  // namespace whisker::hil

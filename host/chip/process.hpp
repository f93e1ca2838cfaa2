#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <sys/types.h>

namespace whisker::chip {

/// The chip, or its emulator, gave no valid answer.
class ChipError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A shell command with pipes to its standard input and output. The destructor gives it two seconds to end by
/// itself.
class Process {
 public:
  /// Throws ChipError.
  explicit Process(const std::string& command);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Both wait for all bytes and throw ChipError if the process ends or is silent for half a minute.
  void write(const std::uint8_t* from, std::size_t count);
  void read(std::uint8_t* to, std::size_t count);

 private:
  [[noreturn]] void fail(const char* what) const;
  void wait_for(int file, short event) const;

  std::string command_;
  pid_t child_ = -1;
  int to_child_ = -1;
  int from_child_ = -1;
};

}  // namespace whisker::chip

#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>

namespace whisker::vcan {

/// Standard output of a shell command. Throws if it fails.
inline std::string shell(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("no shell");
  std::string printed;
  char part[256];
  while (std::fgets(part, sizeof part, pipe) != nullptr) printed += part;
  if (pclose(pipe) != 0) throw std::runtime_error(command + ": failed; under scripts/with-vcan?");
  return printed;
}

/// A command that runs until wait().
class Running {
 public:
  explicit Running(const std::string& command) : pipe_(popen(command.c_str(), "r")) {
    if (pipe_ == nullptr) throw std::runtime_error("no shell");
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    if (pipe_ != nullptr) pclose(pipe_);
  }
  /// Its output until its end.
  std::string wait() {
    std::string printed;
    char part[256];
    while (std::fgets(part, sizeof part, pipe_) != nullptr) printed += part;
    pclose(pipe_);
    pipe_ = nullptr;
    return printed;
  }

 private:
  FILE* pipe_;
};

}  // namespace whisker::vcan

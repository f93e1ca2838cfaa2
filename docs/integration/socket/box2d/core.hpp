// The core, in a process of its own: `whisker socket --stdio`.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

class Core {
 public:
  // whisker: the command.
  explicit Core(const std::string& whisker);
  ~Core();
  Core(const Core&) = delete;
  Core& operator=(const Core&) = delete;

  // Sends a line and returns the answer. Throws std::runtime_error if the answer is an error, or none comes.
  nlohmann::json ask(const nlohmann::json& line);

 private:
  pid_t child_ = -1;
  std::FILE* to_ = nullptr;
  std::FILE* from_ = nullptr;
};

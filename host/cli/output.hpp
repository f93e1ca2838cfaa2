/// Where results go.
#pragma once

#include <string>
#include <vector>

namespace whisker::cli {

/// Before any work is done: every named output ("" means none) must lie in a folder that exists, no two may
/// be the same file, and none an input. Devices and pipes may be named twice. Throws UsageError.
void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs = {});

/// When all is printed: throws std::runtime_error if standard output did not take all of it.
void finish_standard_output();

/// A line on the terminal that is written over and over; silent where standard error is no terminal.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void show(const std::string& text);

 private:
  bool terminal_;
  bool shown_ = false;
};

}  // namespace whisker::cli

/// Where results go.
#pragma once

#include <initializer_list>
#include <string>

namespace whisker::cli {

/// Before any work is done: every named file ("" means none) must lie in a folder that exists, and no two
/// may be the same. Throws UsageError.
void check_outputs(std::initializer_list<std::string> paths);

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

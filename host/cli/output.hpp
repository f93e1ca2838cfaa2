/// Where results go.
#pragma once

#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace whisker::cli {

/// Before any work is done: every named output ("" means none) must lie in a folder that exists, no two may
/// be the same file, and none an input. Devices and pipes may be named twice. "-" is standard output: at most
/// one output may be that, and none if it is taken, by the object of --json. Throws UsageError.
void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs = {},
                   bool standard_output_is_taken = false);

/// Where words for people go: standard error if one of these outputs is standard output.
std::FILE* words_beside(std::initializer_list<std::string_view> outputs);

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

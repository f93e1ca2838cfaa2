/// Outputs of the commands.
#pragma once

#include <cstdio>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <signal.h>

namespace whisker::cli {

/// Checks before any work starts: every named output ("" means none) must lie in an existing folder, no two
/// may be the same file, and none an input. Devices and pipes may be named twice. "-" is standard output: at
/// most one output may use it, and none if --json does. Throws UsageError.
void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs = {},
                   bool standard_output_is_taken = false);

/// Stream for text for people: standard error if one of these outputs is standard output.
std::FILE* words_beside(std::initializer_list<std::string_view> outputs);

/// Call at the end: throws std::runtime_error if standard output did not accept everything.
void finish_standard_output();

/// A terminal line that is overwritten; silent if standard error is not a terminal.
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

/// SIGINT and SIGTERM end the command with a line and kInterrupted, where no Interrupt records them.
void end_on_signals();

/// During its lifetime, SIGINT, SIGTERM and SIGHUP are only recorded. One within another shares what
/// is recorded.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool noted() const;  ///< a signal was received

 private:
  struct sigaction old_[3]{};
};

}  // namespace whisker::cli

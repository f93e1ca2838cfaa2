#include "host/cli/output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

#include <fmt/core.h>

#include "host/cli/exit_status.hpp"

namespace whisker::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStandardOutput = "-";

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

/// Devices and pipes may be named more than once.
bool is_device(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_regular_file(path, error);
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (is_device(a) || is_device(b)) return false;
  if (fs::equivalent(a, b, error)) return true;
  return a.filename() == b.filename() && fs::equivalent(folder_of(a), folder_of(b), error);
}

void check_place(const std::string& text) {
  std::error_code error;
  const fs::path path = text;
  if (!fs::is_directory(folder_of(path), error)) {
    throw UsageError(fmt::format("{}: no such folder: {}", text, folder_of(path).string()));
  }
  if (!path.has_filename() || fs::is_directory(path, error)) {
    throw UsageError(fmt::format("{}: is a folder", text));
  }
}

volatile sig_atomic_t g_noted = 0;
int g_interrupts = 0;

void note(int) { g_noted = 1; }

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

pid_t g_speaker = 0;  // a process that it has forked says nothing

void end(int) {
  constexpr std::string_view kWipe = "\r\033[K", kWords = "whisker: interrupted\n";
  if (getpid() != g_speaker) _exit(kInterrupted);
  const std::string_view words[] = {isatty(STDERR_FILENO) == 1 ? kWipe : "", kWords};
  for (const std::string_view text : words) {
    if (::write(STDERR_FILENO, text.data(), text.size()) < 0) break;
  }
  _exit(kInterrupted);
}

}  // namespace

void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                   bool standard_output_is_taken) {
  std::vector<std::string> seen;
  for (const std::string& text : outputs) {
    if (text.empty()) continue;
    if (text == kStandardOutput) {
      if (standard_output_is_taken)
        throw UsageError("-: standard output is for what another option prints there");
      standard_output_is_taken = true;
      continue;
    }
    check_place(text);
    for (const std::string& input : inputs) {
      if (!input.empty() && same_file(text, input)) {
        throw UsageError(fmt::format("{}: would overwrite the input {}", text, input));
      }
    }
    for (const std::string& other : seen) {
      if (same_file(text, other)) throw UsageError(fmt::format("{}: named for two outputs", text));
    }
    seen.push_back(text);
  }
}

std::FILE* words_beside(std::initializer_list<std::string_view> outputs) {
  return std::find(outputs.begin(), outputs.end(), kStandardOutput) == outputs.end() ? stdout : stderr;
}

void finish_standard_output() {
  errno = 0;
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout.flush();
  if (!lost) return;
  // An earlier error of iostream leaves no errno.
  const std::string why = errno != 0 ? ": " + std::generic_category().message(errno) : "";
  throw std::runtime_error("cannot write to standard output" + why);
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

void ProgressLine::show(const std::string& text) {
  if (!terminal_) return;
  fmt::print(stderr, "\r\033[K{}", text);
  std::fflush(stderr);
  shown_ = true;
}

void end_on_signals() {
  g_speaker = getpid();
  signal(SIGINT, end);
  signal(SIGTERM, end);
  signal(SIGXFSZ, SIG_IGN);  // the write fails instead
}

Interrupt::Interrupt() {
  if (g_interrupts++ > 0) return;
  g_noted = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    sigaction(kSignals[i], &action, &old_[i]);
    // nohup
    if (kSignals[i] == SIGHUP && old_[i].sa_handler == SIG_IGN) sigaction(SIGHUP, &old_[i], nullptr);
  }
}

Interrupt::~Interrupt() {
  if (--g_interrupts > 0) return;
  for (std::size_t i = 0; i < std::size(kSignals); ++i) sigaction(kSignals[i], &old_[i], nullptr);
}

bool Interrupt::noted() const { return g_noted != 0; }

}  // namespace whisker::cli

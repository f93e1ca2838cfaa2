#include "host/cli/output.hpp"

#include <unistd.h>

#include <filesystem>
#include <set>

#include <fmt/core.h>

#include "host/cli/exit_status.hpp"

namespace whisker::cli {

void check_outputs(std::initializer_list<std::string> paths) {
  std::set<std::filesystem::path> seen;
  for (const std::string& text : paths) {
    if (text.empty()) continue;
    std::error_code error;
    const std::filesystem::path path = text;
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (!std::filesystem::is_directory(folder, error)) {
      throw UsageError(fmt::format("{}: no such folder: {}", text, folder.string()));
    }
    if (std::filesystem::is_directory(path, error)) throw UsageError(fmt::format("{}: is a folder", text));
    const bool device = std::filesystem::is_character_file(path, error);
    if (!device && !seen.insert(std::filesystem::weakly_canonical(path, error)).second) {
      throw UsageError(fmt::format("{}: named for two outputs", text));
    }
  }
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

}  // namespace whisker::cli

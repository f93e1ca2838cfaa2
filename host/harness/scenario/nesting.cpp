#include "host/harness/scenario/nesting.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "host/harness/scenario/error.hpp"

namespace whisker {
namespace {

constexpr int kMostParts = 8;   ///< of a dotted key
constexpr int kMostLevels = 8;  ///< of arrays and inline tables

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skip_string(c);
        continue;
      }
      if (c == '#') {
        skip_comment();
        continue;
      }
      count(c);
      ++at_;
      if (c == '\n') ++line_, line_begin_ = at_;
    }
  }

 private:
  void count(char c) {
    if (c == '.') {
      if (++dots_ >= kMostParts) fail(fmt::format("a key has more than {} parts", kMostParts));
    } else if (c == '[' || c == '{') {
      dots_ = 0;
      if (level_ == 0 && text_.substr(line_begin_, at_ - line_begin_).find_first_not_of(" \t") == npos)
        header_ = true;
      if (++level_ > kMostLevels) fail(fmt::format("values are nested more than {} deep", kMostLevels));
    } else if (c == ']' || c == '}') {
      dots_ = 0;
      if (level_ > 0) --level_;
    } else if (c == '\n' || c == '=' || c == ',') {
      dots_ = 0;
      // A header ends with its line; toml++ reports an unclosed one.
      if (c == '\n' && header_) level_ = 0, header_ = false;
    }
  }

  bool here(std::string_view what) const { return text_.substr(at_, what.size()) == what; }

  /// A single-line string ends with its line, closed or not; a multi-line string ends where it is closed.
  void skip_string(char quote) {
    const std::string triple(3, quote);
    const bool several_lines = here(triple);
    at_ += several_lines ? 3 : 1;
    while (at_ < text_.size()) {
      if (several_lines ? here(triple) : text_[at_] == quote) {
        at_ += several_lines ? 3 : 1;
        return;
      }
      if (text_[at_] == '\n') {
        if (!several_lines) return;
        ++line_, line_begin_ = at_ + 1;
      }
      const bool escaped =
          quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n';
      at_ += std::size_t{escaped} + 1;
    }
  }

  void skip_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(file_, line_, at_ - line_begin_ + 1, what);
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t line_begin_ = 0;
  int dots_ = 0;
  int level_ = 0;
  bool header_ = false;  ///< in a line that starts with a bracket
  static constexpr std::size_t npos = std::string_view::npos;
};

}  // namespace

void check_nesting(std::string_view text, const std::string& file) { Scanner(text, file).run(); }

}  // namespace whisker

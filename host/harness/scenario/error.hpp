#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace whisker {

/// The text with '?' for each control character: what others wrote must not act on a terminal.
std::string one_line(std::string text);

/// Invalid input from a user. what() is one line, `FILE:LINE:COLUMN: what is wrong`; an error of the whole
/// file (missing, unreadable) is reported at 1:1.
class InputError : public std::runtime_error {
 public:
  /// Lines and columns count from 1; control characters in the texts become '?'.
  InputError(std::string_view file, std::size_t line, std::size_t column, std::string_view what);
  std::size_t line() const noexcept { return line_; }
  std::size_t column() const noexcept { return column_; }

 private:
  std::size_t line_;
  std::size_t column_;
};

/// Prints it on standard error: a word to the user that is no failure. Each text once.
void notice(const InputError& what);

/// Several errors; what() is the first.
class InputErrors : public InputError {
 public:
  /// errors: at least one. changes: lines of a robot file, key and value, that end all of them.
  using Changes = std::vector<std::pair<std::string, std::string>>;
  explicit InputErrors(std::vector<InputError> errors, std::string advice = "", Changes changes = {})
      : InputError(errors.front()),
        all_(std::move(errors)),
        advice_(std::move(advice)),
        changes_(std::move(changes)) {}
  const std::vector<InputError>& all() const noexcept { return all_; }
  /// What ends all of them, one line; may be empty.
  const std::string& advice() const noexcept { return advice_; }
  const Changes& changes() const noexcept { return changes_; }

 private:
  std::vector<InputError> all_;
  std::string advice_;
  Changes changes_;
};

}  // namespace whisker

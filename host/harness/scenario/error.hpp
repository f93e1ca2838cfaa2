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

/// Several errors; what() is the first.
class InputErrors : public InputError {
 public:
  /// errors: at least one.
  explicit InputErrors(std::vector<InputError> errors)
      : InputError(errors.front()), all_(std::move(errors)) {}
  const std::vector<InputError>& all() const noexcept { return all_; }

 private:
  std::vector<InputError> all_;
};

}  // namespace whisker

#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace whisker {

/// Bad input from a user. what() is one line, `FILE:LINE:COLUMN: what is wrong`;
/// a fault of a file as a whole (missing, unreadable) is reported at 1:1.
class InputError : public std::runtime_error {
 public:
  /// Lines and columns count from 1; control characters in the texts become '?'.
  InputError(std::string_view file, std::size_t line, std::size_t column, std::string_view what);
};

}  // namespace whisker

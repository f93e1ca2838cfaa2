#include "host/harness/scenario/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace whisker {
namespace {

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7F'; }, '?');
  return text;
}

}  // namespace

InputError::InputError(std::string_view file, std::size_t line, std::size_t column, std::string_view what)
    : std::runtime_error(one_line(fmt::format("{}:{}:{}: {}", file, line, column, what))),
      line_(line),
      column_(column) {}

}  // namespace whisker

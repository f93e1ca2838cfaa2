#include "host/harness/scenario/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <set>

namespace whisker {

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7F'; }, '?');
  // U+0080 to U+009F
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '\xC2' && static_cast<unsigned char>(text[i + 1]) < 0xA0) text.replace(i, 2, "?");
  }
  return text;
}

InputError::InputError(std::string_view file, std::size_t line, std::size_t column, std::string_view what)
    : std::runtime_error(one_line(fmt::format("{}:{}:{}: {}", file, line, column, what))),
      line_(line),
      column_(column) {}

void notice(const InputError& what) {
  static std::mutex mutex;
  static std::set<std::string> said;
  const std::lock_guard lock(mutex);
  if (said.insert(what.what()).second) fmt::print(stderr, "{}\n", what.what());
}

}  // namespace whisker

/// Small text tools of the file formats.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace whisker {

/// The shortest decimal that reads back as the same double, with a point or an exponent so that TOML parses
/// it as a float.
std::string toml_number(double x);

/// Quoted and escaped as a TOML basic string.
std::string toml_string(std::string_view text);

/// The known word most similar to a misspelt one; empty if none is close.
std::string_view nearest_word(std::string_view word, const std::vector<std::string_view>& known);

inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// Without the blanks around it.
std::string_view trimmed(std::string_view text);

/// "a, b or c".
std::string join_or(const std::vector<std::string_view>& words);

}  // namespace whisker

#include "host/lab/rules/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace whisker::rules {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";

/// False if the word is not a number in decimal.
bool parse(std::string_view text, double& out) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, out);
  return !text.empty() && error == std::errc{} && stop == end;
}

}  // namespace

Place Source::place(std::size_t at) const {
  at = std::min(at, text_.size());
  const std::string_view before = text_.substr(0, at);
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  return {line + 1, at - line_start + 1};
}

void Source::fail(std::size_t at, std::string_view what) const { fail(place(at), what); }

void Source::fail(Place at, std::string_view what) const {
  throw InputError(file_, at.line, at.column, what);
}

void Source::warn(Place at, std::string_view what) const {
  warnings_.push_back(InputError(file_, at.line, at.column, what).what());
}

std::vector<Word> Source::lines() const {
  std::vector<Word> all;
  std::size_t from = 0;
  while (from < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', from), text_.size());
    all.push_back({text_.substr(from, end - from), from});
    from = end + 1;
  }
  return all;
}

double Source::number_or_infinity(const Word& word) const {
  double x = 0;
  if (!parse(word.text, x) || std::isnan(x)) fail(word, fmt::format("'{}' is not a number", word.text));
  if (std::isfinite(x) && std::abs(x) > kGreatest)
    fail(word, fmt::format("{} is larger than 1e9", word.text));
  return x;
}

double Source::number(const Word& word) const {
  const double x = number_or_infinity(word);
  if (!std::isfinite(x)) fail(word, fmt::format("'{}' must be finite", word.text));
  return x;
}

long Source::whole(const Word& word, long low, long high) const {
  const double x = number(word);
  if (x != std::floor(x)) fail(word, fmt::format("'{}' is not a whole number", word.text));
  if (x < static_cast<double>(low) || x > static_cast<double>(high))
    fail(word, fmt::format("{} must be from {} to {}", word.text, low, high));
  return static_cast<long>(x);
}

std::size_t Source::index_of(const Word& word, const std::vector<std::string_view>& names,
                             std::string_view what) const {
  return find(word, names, fmt::format("unknown {} '{}'", what, word.text));
}

std::size_t Source::index_of_term(const Word& word, const std::vector<std::string_view>& names,
                                  std::string_view variable) const {
  return find(word, names, fmt::format("'{}' has no term '{}'", variable, word.text));
}

std::size_t Source::find(const Word& word, const std::vector<std::string_view>& names,
                         const std::string& otherwise) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == word.text) return i;
  const std::string_view near = nearest_word(word.text, names);
  fail(word, otherwise + (near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

Word trimmed(Word word) {
  const std::size_t from = word.text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {word.text.substr(0, 0), word.at};
  const std::size_t to = word.text.find_last_not_of(kBlanks);
  return {word.text.substr(from, to - from + 1), word.at + from};
}

std::vector<Word> split(Word word, bool commas) {
  const std::string blanks = std::string(kBlanks) + (commas ? "," : "");
  std::vector<Word> parts;
  for (std::size_t at = word.text.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(word.text.find_first_of(blanks, at), word.text.size());
    parts.push_back({word.text.substr(at, end - at), word.at + at});
    at = word.text.find_first_not_of(blanks, end);
  }
  return parts;
}

Halves split_at(Word word, char c) {
  const std::size_t at = word.text.find(c);
  if (at == std::string_view::npos) return {word, {{}, word.at + word.text.size()}, false};
  return {{word.text.substr(0, at), word.at}, {word.text.substr(at + 1), word.at + at + 1}, true};
}

}  // namespace whisker::rules

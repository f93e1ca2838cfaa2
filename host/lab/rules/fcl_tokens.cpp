#include "host/lab/rules/fcl_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace whisker::rules {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";
constexpr std::string_view kSigns = ":;(),|=";

/// Length of the token that starts here.
std::size_t length(std::string_view rest) {
  if (rest.substr(0, 2) == ":=" || rest.substr(0, 2) == "..") return 2;
  if (kSigns.find(rest.front()) != std::string_view::npos) return 1;
  std::size_t n = 1;
  while (n < rest.size() && kBlanks.find(rest[n]) == std::string_view::npos &&
         kSigns.find(rest[n]) == std::string_view::npos && rest.substr(n, 2) != "..") {
    ++n;
  }
  return n;
}

}  // namespace

std::string without_fcl_comments(std::string_view text) {
  std::string out(text);
  const auto blank = [&out](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < std::min(to, out.size()); ++i)
      if (out[i] != '\n') out[i] = ' ';
  };
  for (std::size_t i = 0; i + 1 < out.size(); ++i) {
    const std::string_view two = text.substr(i, 2);
    std::size_t end = i;
    if (two == "(*") end = text.find("*)", i + 2);
    if (two == "/*") end = text.find("*/", i + 2);
    if (two == "//") {
      end = std::min(text.find('\n', i), text.size());
      blank(i, end);
    } else if (end != i) {
      end = end == std::string_view::npos ? text.size() : end + 2;
      blank(i, end);
    }
    if (end != i) i = end - 1;
  }
  return out;
}

FclTokens::FclTokens(const Source& source) : source_(source), end_{{}, source.text().size()} {
  const std::string_view text = source.text();
  for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t n = length(text.substr(at));
    tokens_.push_back({text.substr(at, n), at});
    at = text.find_first_not_of(kBlanks, at + n);
  }
}

bool FclTokens::take(std::string_view keyword) {
  if (ended() || lower_case(tokens_[at_].text) != keyword) return false;
  ++at_;
  return true;
}

void FclTokens::expect(std::string_view keyword) {
  if (take(keyword)) return;
  std::string upper(keyword);
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  if (ended()) source_.fail(end_, fmt::format("the file ends where '{}' is expected", upper));
  source_.fail(peek(), fmt::format("'{}' is expected, but this is '{}'", upper, peek().text));
}

Word FclTokens::next(std::string_view what) {
  if (ended()) source_.fail(end_, fmt::format("the file ends where {} is expected", what));
  return tokens_[at_++];
}

void FclTokens::skip_to_semicolon() {
  while (next("';'") != ";") {
  }
}

Word FclTokens::rule_text() {
  while (!take(":")) {
    const Word word = next("':'");
    if (word == ";") source_.fail(word, "':' is expected after the number of the rule");
  }
  const Word first = peek();
  std::size_t end = first.at;
  while (!ended() && peek() != ";" && lower_case(peek().text) != "rule" &&
         lower_case(peek().text) != "end_ruleblock") {
    const Word word = next("';'");
    end = word.at + word.text.size();
  }
  take(";");
  return {source_.text().substr(first.at, end - first.at), first.at};
}

}  // namespace whisker::rules

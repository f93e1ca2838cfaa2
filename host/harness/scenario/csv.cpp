#include "host/harness/scenario/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/text.hpp"

namespace whisker {
namespace {

constexpr std::size_t kLongestLine = 65536;
constexpr std::size_t kMostLines = 100000000;
constexpr double kMostNumber = 1e9;

}  // namespace

std::string_view without_mark(std::string_view text, const std::string& name) {
  const std::string_view two = text.substr(0, 2);
  if (two == "\xFF\xFE" || two == "\xFE\xFF")
    throw InputError(name, 1, 1, "the text is UTF-16; save it as UTF-8");
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  return text;
}

bool LineReader::next() {
  line_.clear();
  ++number_;
  int c = 0;
  try {
    while ((c = in_.rdbuf()->sbumpc()) != std::char_traits<char>::eof() && c != '\n') {
      line_ += static_cast<char>(c);
      if (line_.size() > kLongestLine) fail(1, fmt::format("a line of more than {} bytes", kLongestLine));
    }
  } catch (const std::ios_base::failure&) {
    fail(1, "cannot read the file");
  }
  if (c != '\n') in_.setstate(std::ios::eofbit);
  if (c != '\n' && line_.empty()) return false;
  if (number_ > kMostLines) fail(1, fmt::format("more than {} lines", kMostLines));
  if (number_ == 1) line_ = without_mark(line_, name_);
  if (!line_.empty() && line_.back() == '\r') line_.pop_back();
  return true;
}

void LineReader::fail(std::size_t column, std::string_view what) const {
  throw InputError(name_, number_, column, what);
}

CsvReader::CsvReader(std::istream& in, const std::string& name) : lines_(in, name) {
  if (!lines_.next()) lines_.fail(1, "the file is empty");
  const std::string& line = lines_.line();
  if (line.find(',') == std::string::npos && line.find(';') != std::string::npos) separator_ = ';';
  header_ = split();
}

std::vector<std::string> CsvReader::split() const {
  std::vector<std::string> fields(1);
  bool quotes = false;
  for (const char c : lines_.line()) {
    if (c == '"') {
      quotes = !quotes;
    } else if (c == separator_ && !quotes) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

std::size_t CsvReader::find(std::string_view column) const {
  const auto at = std::find(header_.begin(), header_.end(), column);
  return at == header_.end() ? kNone : static_cast<std::size_t>(at - header_.begin());
}

std::size_t CsvReader::need(std::string_view column) const {
  const std::size_t at = find(column);
  if (at == kNone) lines_.fail(1, fmt::format("no column '{}' in the header", column));
  return at;
}

bool CsvReader::next() {
  do {
    if (!lines_.next()) return false;
  } while (trimmed(lines_.line()).empty());
  fields_ = split();
  if (fields_.size() != header_.size())
    lines_.fail(1, fmt::format("{} fields; the header has {}", fields_.size(), header_.size()));
  return true;
}

double CsvReader::number(std::size_t column) {
  std::string text = fields_[column];
  const std::size_t mark = text.find_first_of(",.");
  if (mark != std::string::npos) {
    if (mark_ != 0 && text[mark] != mark_)
      fail(column,
           fmt::format("'{}': other numbers of this file have '{}' before their decimals", text, mark_));
    mark_ = text[mark];
    text[mark] = '.';
  }
  const char* const end = text.data() + text.size();
  double x = 0;
  const auto [stop, error] = std::from_chars(text.data(), end, x);
  if (error != std::errc{} || stop != end || !std::isfinite(x))
    fail(column, fmt::format("'{}' is no number", fields_[column]));
  if (std::abs(x) > kMostNumber)
    fail(column, fmt::format("'{}' must be from -{:g} to {:g}", fields_[column], kMostNumber, kMostNumber));
  return x;
}

}  // namespace whisker

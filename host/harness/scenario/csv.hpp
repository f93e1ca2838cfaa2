/// Texts of lines, and tables in them, as people and spreadsheets write them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace whisker {

/// Removes a byte order mark of UTF-8. Throws InputError if the text is UTF-16, as some editors write it.
std::string_view without_mark(std::string_view text, const std::string& name);

/// Lines without their ends, which may be CRLF, and without a byte order mark.
class LineReader {
 public:
  /// `name` is the name of the file in messages.
  LineReader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

  /// False at the end. Throws InputError for a line of more than 64 KiB, or more than 100 million lines.
  bool next();
  const std::string& line() const { return line_; }
  std::size_t number() const { return number_; }  ///< from 1
  /// The last line has no end of line.
  bool cut() const { return in_.eof(); }
  [[noreturn]] void fail(std::size_t column, std::string_view what) const;

 private:
  std::istream& in_;
  std::string name_;
  std::string line_;
  std::size_t number_ = 0;
};

/// Rows below a header. Fields end at commas, or if the header has semicolons and no commas, at semicolons.
/// Where a comma ends no field, numbers may have a decimal comma. Blanks and quotes around fields do not
/// count, and empty lines are left out. Errors name line and field.
class CsvReader {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Reads the header.
  CsvReader(std::istream& in, const std::string& name);

  /// The place of a column, or kNone; need() fails instead.
  std::size_t find(std::string_view column) const;
  std::size_t need(std::string_view column) const;

  /// The next row; false at the end.
  bool next();
  const std::string& text(std::size_t column) const { return fields_[column]; }
  /// Finite, at most 1e9 in size.
  double number(std::size_t column);
  [[noreturn]] void fail(std::size_t column, std::string_view what) const { lines_.fail(column + 1, what); }

 private:
  std::vector<std::string> split() const;

  LineReader lines_;
  char separator_ = ',';
  char mark_ = 0;  ///< of decimals, once seen
  std::vector<std::string> header_;
  std::vector<std::string> fields_;
};

}  // namespace whisker

/// Writes SVG. Page units are pixels, y down. Equal input gives equal bytes.
#pragma once

#include <string>
#include <string_view>

namespace whisker::report {

struct Point {
  double x = 0;
  double y = 0;
};

/// Text for an element or an attribute in quotes: markup is escaped; bytes that are not UTF-8 and
/// characters that XML forbids become U+FFFD.
std::string escape(std::string_view text);

/// JSON that cannot end the script element that holds it.
std::string script_safe(const std::string& json);

/// Replaces the first mark of a page. Throws std::logic_error if there is none.
void put(std::string& page, std::string_view mark, const std::string& text);

/// At most `characters` characters of UTF-8 text; a longer text ends in an ellipsis.
std::string shortened(std::string_view text, std::size_t characters);

/// A coordinate: at most two decimals, no trailing zeros, never "-0". Values that are not finite become 0;
/// others are limited to +-1e6.
std::string number(double x);

/// A value with fixed decimals for people to read, never "-0.0".
std::string decimals(double x, int count);

class PathData {
 public:
  PathData& move(Point p) { return add('M', p); }
  PathData& line(Point p) { return add('L', p); }
  PathData& dot(Point p);  ///< a stroke of length 0: visible with round caps
  PathData& close();
  PathData& box(Point corner, double width, double height);
  bool empty() const { return text_.empty(); }
  const std::string& text() const { return text_; }

 private:
  PathData& add(char command, Point p);
  std::string text_;
};

/// `attributes` is SVG written by the program, e.g. fill="none"; user text goes through `text` only.
class Svg {
 public:
  /// A light card with rounded corners, so that the picture also works on a dark page.
  Svg(double width, double height, std::string_view title);

  Svg& open(std::string_view attributes);  ///< a group
  Svg& close();
  Svg& rect(Point corner, double width, double height, std::string_view attributes);
  Svg& circle(Point center, double radius, std::string_view attributes);
  Svg& line(Point a, Point b, std::string_view attributes);
  Svg& path(const PathData& data, std::string_view attributes);
  Svg& text(Point at, std::string_view text, std::string_view attributes);
  /// Centred on the place, read from below.
  Svg& text_upwards(Point at, std::string_view text);
  /// A group that is clipped to the rectangle; closed by close(). `id` is unique in the file.
  Svg& open_clipped(std::string_view id, Point corner, double width, double height);

  /// The whole file.
  std::string finish() &&;

 private:
  std::string out_;
};

}  // namespace whisker::report

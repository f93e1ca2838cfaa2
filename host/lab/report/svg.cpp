#include "host/lab/report/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace whisker::report {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// The length of the well-formed character at the start of `text`, 0 if there is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  std::uint32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return 0;
    code = (code << 6) | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < kSmallest[length] || code > 0x10FFFF || surrogate ? 0 : length;
}

bool forbidden(std::string_view character) {
  const auto c = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return c < 0x20 && c != '\t' && c != '\n' && c != '\r';
  return character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
}

std::string_view markup(char c) {
  switch (c) {
    case '&': return "&amp;";
    case '<': return "&lt;";
    case '>': return "&gt;";
    case '"': return "&quot;";
    case '\'': return "&#39;";
    case '\r': return "&#13;";
    default: return {};
  }
}

/// Six decimals suffice for any page; more would only enlarge the file.
double on_page(double x) { return std::isfinite(x) ? std::clamp(x, -1e6, 1e6) : 0.0; }

}  // namespace

std::string escape(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    if (length == 0 || forbidden(character)) {
      out += kReplacement;
    } else if (const std::string_view m = markup(character[0]); !m.empty()) {
      out += m;
    } else {
      out += character;
    }
    text.remove_prefix(character.size());
  }
  return out;
}

std::string script_safe(const std::string& json) {
  std::string text;
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

void put(std::string& page, std::string_view mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw std::logic_error("the page's template has no " + std::string(mark));
  page.replace(at, mark.size(), text);
}

std::string shortened(std::string_view text, std::size_t characters) {
  std::size_t end = 0;
  std::size_t last = 0;
  for (std::size_t n = 0; end < text.size(); ++n) {
    if (n == characters) return std::string(text.substr(0, last)) + "\xE2\x80\xA6";
    last = end;
    end += std::max<std::size_t>(character_length(text.substr(end)), 1);
  }
  return std::string(text);
}

std::string number(double x) {
  std::string s = fmt::format("{:.2f}", on_page(x));
  while (s.back() == '0') s.pop_back();
  if (s.back() == '.') s.pop_back();
  return s == "-0" ? "0" : s;
}

std::string decimals(double x, int count) {
  const double limit = 0.5 * std::pow(10.0, -count);
  return fmt::format("{:.{}f}", std::fabs(x) < limit ? 0.0 : x, count);
}

PathData& PathData::add(char command, Point p) {
  text_ += command;
  text_ += number(p.x);
  text_ += ' ';
  text_ += number(p.y);
  return *this;
}

PathData& PathData::dot(Point p) {
  move(p);
  text_ += "h0";
  return *this;
}

PathData& PathData::close() {
  text_ += 'Z';
  return *this;
}

PathData& PathData::box(Point corner, double width, double height) {
  move(corner);
  text_ += fmt::format("h{}v{}h{}z", number(width), number(height), number(-width));
  return *this;
}

Svg::Svg(double width, double height, std::string_view title) {
  const std::string w = number(width);
  const std::string h = number(height);
  out_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n<title>{2}</title>\n",
      w, h, escape(title));
  rect({0.5, 0.5}, width - 1, height - 1, R"(class="card" rx="8" fill="#fbfbf9" stroke="#c8c8c4")");
}

Svg& Svg::open(std::string_view attributes) {
  out_ += fmt::format("<g {}>\n", attributes);
  return *this;
}

Svg& Svg::close() {
  out_ += "</g>\n";
  return *this;
}

Svg& Svg::rect(Point corner, double width, double height, std::string_view attributes) {
  out_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n", number(corner.x),
                      number(corner.y), number(width), number(height), attributes);
  return *this;
}

Svg& Svg::circle(Point center, double radius, std::string_view attributes) {
  out_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", number(center.x), number(center.y),
                      number(radius), attributes);
  return *this;
}

Svg& Svg::line(Point a, Point b, std::string_view attributes) {
  out_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", number(a.x), number(a.y),
                      number(b.x), number(b.y), attributes);
  return *this;
}

Svg& Svg::path(const PathData& data, std::string_view attributes) {
  if (!data.empty()) out_ += fmt::format("<path d=\"{}\" {}/>\n", data.text(), attributes);
  return *this;
}

Svg& Svg::text(Point at, std::string_view text, std::string_view attributes) {
  out_ += fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", number(at.x), number(at.y), attributes,
                      escape(text));
  return *this;
}

Svg& Svg::text_upwards(Point at, std::string_view text_) {
  return text(
      at, text_,
      fmt::format(R"svg(text-anchor="middle" transform="rotate(-90 {} {})")svg", number(at.x), number(at.y)));
}

Svg& Svg::open_clipped(std::string_view id, Point corner, double width, double height) {
  out_ += fmt::format("<clipPath id=\"{}\">", id);
  rect(corner, width, height, "");
  out_ += fmt::format("</clipPath>\n<g clip-path=\"url(#{})\">\n", id);
  return *this;
}

std::string Svg::finish() && {
  out_ += "</svg>\n";
  return std::move(out_);
}

}  // namespace whisker::report

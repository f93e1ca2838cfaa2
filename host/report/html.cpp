#include "host/report/html.hpp"

#include <stdexcept>

namespace whisker::report {

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

}  // namespace whisker::report

#include "tests/report/xml.hpp"

#include <expat.h>

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>

namespace whisker::testing {
namespace {

struct Builder {
  Element root;
  std::vector<Element*> open = {&root};
};

void on_start(void* user, const XML_Char* name, const XML_Char** attributes) {
  auto& builder = *static_cast<Builder*>(user);
  Element element;
  element.name = name;
  for (; *attributes != nullptr; attributes += 2) element.attributes[attributes[0]] = attributes[1];
  builder.open.back()->children.push_back(std::move(element));
  builder.open.push_back(&builder.open.back()->children.back());
}

void on_end(void* user, const XML_Char*) { static_cast<Builder*>(user)->open.pop_back(); }

void on_text(void* user, const XML_Char* text, int length) {
  static_cast<Builder*>(user)->open.back()->text.append(text, static_cast<std::size_t>(length));
}

/// Digits, with an optional leading sign and at most one decimal point.
bool plain_number(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789";
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  const std::size_t whole = std::min(text.find_first_not_of(kDigits), text.size());
  const std::string_view rest = text.substr(whole);
  if (whole == 0 || rest.empty()) return whole > 0;
  return rest.front() == '.' && rest.size() > 1 &&
         rest.find_first_not_of(kDigits, 1) == std::string_view::npos;
}

template <class Match>
void collect(const Element& element, const Match& match, std::vector<const Element*>& out) {
  if (match(element)) out.push_back(&element);
  for (const Element& child : element.children) collect(child, match, out);
}

}  // namespace

bool Element::has_class(std::string_view word) const {
  const auto it = attributes.find("class");
  if (it == attributes.end()) return false;
  return (" " + it->second + " ").find(" " + std::string(word) + " ") != std::string::npos;
}

double Element::number(const std::string& attribute) const { return std::stod(attributes.at(attribute)); }

std::vector<const Element*> Element::by_class(std::string_view word) const {
  std::vector<const Element*> out;
  collect(
      *this, [&](const Element& e) { return e.has_class(word); }, out);
  return out;
}

std::vector<const Element*> Element::by_name(std::string_view tag) const {
  std::vector<const Element*> out;
  collect(
      *this, [&](const Element& e) { return e.name == tag; }, out);
  return out;
}

std::vector<std::string> Element::texts_of_class(std::string_view word) const {
  std::vector<std::string> all;
  for (const Element* group : by_class(word)) {
    for (const Element* words : group->by_name("text")) all.push_back(words->text);
  }
  return all;
}

Element parse_xml(std::string_view text) {
  Builder builder;
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate("UTF-8"),
                                                                       XML_ParserFree);
  XML_SetUserData(parser.get(), &builder);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), 1) != XML_STATUS_OK)
    throw std::runtime_error(std::string(XML_ErrorString(XML_GetErrorCode(parser.get()))) + " in line " +
                             std::to_string(XML_GetCurrentLineNumber(parser.get())));
  return builder.root.children.at(0);
}

std::string odd_coordinate(const Element& root) {
  static const std::set<std::string> kPlain = {"x",  "y",  "x1", "y1",    "x2",     "y2",
                                               "cx", "cy", "r",  "width", "height", "stroke-width"};
  static const std::string kPathCharacters = "0123456789.- MLHVZhvz";
  for (const auto& [key, value] : root.attributes) {
    if (kPlain.count(key) != 0 && !plain_number(value)) return key + "=" + value;
    if (key == "d" && value.find_first_not_of(kPathCharacters) != std::string::npos) return "d with " + value;
    if (key == "viewBox" && value.find_first_not_of("0123456789. ") != std::string::npos) return value;
  }
  for (const Element& child : root.children)
    if (const std::string odd = odd_coordinate(child); !odd.empty()) return odd;
  return {};
}

}  // namespace whisker::testing

/// A file parsed with expat, for queries in tests.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace whisker::testing {

struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;
  std::vector<Element> children;

  /// Whether the word is in the class attribute.
  bool has_class(std::string_view word) const;
  double number(const std::string& attribute) const;
  /// The element and all descendants with this class, in document order.
  std::vector<const Element*> by_class(std::string_view word) const;
  std::vector<const Element*> by_name(std::string_view tag) const;
  /// The texts of the <text> elements below those of the class, in document order.
  std::vector<std::string> texts_of_class(std::string_view word) const;
};

/// Throws std::runtime_error with expat's message and the line if the text is not well-formed.
Element parse_xml(std::string_view text);

/// The first coordinate in any attribute that is not a plain decimal number, or an empty string.
std::string odd_coordinate(const Element& root);

}  // namespace whisker::testing

#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace whisker::view {

/// Names of hosts and headers are case-insensitive.
inline std::string lower(std::string_view text) {
  std::string all(text);
  std::transform(all.begin(), all.end(), all.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return all;
}

}  // namespace whisker::view

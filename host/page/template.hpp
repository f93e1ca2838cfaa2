/// The page without its data, as host/web builds it.
#pragma once

#include <string_view>
#include <vector>

namespace whisker::page {

/// One after the other they are template.html.
const std::vector<std::string_view>& template_parts();

/// Where the data goes; it occurs once.
constexpr std::string_view kDataMark = "<!--data-->";

/// What the page may load: nothing.
constexpr std::string_view kPolicy = "default-src 'none';";

}  // namespace whisker::page

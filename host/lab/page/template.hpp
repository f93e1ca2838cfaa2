/// The page without its data, built by host/lab/web.
#pragma once

#include <string_view>
#include <vector>

namespace whisker::page {

/// Joined, they are template.html.
const std::vector<std::string_view>& template_parts();

/// The mark that the data replaces; it occurs once.
constexpr std::string_view kDataMark = "<!--data-->";

/// Content security policy: the page may load nothing.
constexpr std::string_view kPolicy = "default-src 'none';";

}  // namespace whisker::page

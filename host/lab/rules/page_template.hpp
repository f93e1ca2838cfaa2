/// The page of a rule base without its data.
#pragma once

#include <string_view>
#include <vector>

namespace whisker::rules {

/// Joined, they are page.html.
const std::vector<std::string_view>& template_parts();

}  // namespace whisker::rules

/// Pages for a browser.
#pragma once

#include <string>
#include <string_view>

namespace whisker::report {

/// JSON that cannot end the script element that holds it.
std::string script_safe(const std::string& json);

/// Replaces the first mark. Throws std::logic_error if there is none.
void put(std::string& page, std::string_view mark, const std::string& text);

}  // namespace whisker::report

#pragma once

#include <string>
#include <string_view>

namespace whisker {

/// Throws InputError if a TOML text is nested deeper than any valid file, because toml++ recurses once per
/// level and would run out of stack. toml++ reports all other errors.
void check_nesting(std::string_view text, const std::string& file);

}  // namespace whisker

#pragma once

#include <string>
#include <string_view>

namespace whisker {

/// Throws InputError where a TOML text nests deeper than any file of ours: toml++ calls itself once a level,
/// and would run out of stack. Whatever else is wrong is left to toml++.
void check_nesting(std::string_view text, const std::string& file);

}  // namespace whisker

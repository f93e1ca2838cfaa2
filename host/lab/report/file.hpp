/// Writes a file completely or not at all.
#pragma once

#include <string>
#include <string_view>

namespace whisker::report {

/// Replaces the file at `path` by `text`: it is written beside it, then renamed, so that a reader sees the
/// old or the new file. A symbolic link stays a link. A device or a pipe (/dev/stdout, /dev/null) cannot be
/// replaced and is written directly, and so is standard output, "-". Throws std::runtime_error "cannot write
/// PATH: REASON", and then leaves no trace.
void write_file(const std::string& path, std::string_view text);

/// JSON that cannot end the script element that holds it.
std::string script_safe(const std::string& json);

/// Replaces the first mark. Throws std::logic_error if there is none.
void put(std::string& page, std::string_view mark, const std::string& text);

}  // namespace whisker::report

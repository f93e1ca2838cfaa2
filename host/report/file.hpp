/// Writes a file whole or not at all.
#pragma once

#include <string>
#include <string_view>

namespace whisker::report {

/// Replaces the file at `path` by `text`: written beside it, then renamed, so that a reader sees the
/// old file or the new one and never half of one. A symbolic link stays a link. A device or a pipe
/// (/dev/stdout, /dev/null) cannot be replaced and is written to directly, and so is standard output, "-".
/// Throws std::runtime_error "cannot write PATH: REASON"; then no trace of the attempt is left.
void write_file(const std::string& path, std::string_view text);

}  // namespace whisker::report

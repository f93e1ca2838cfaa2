#pragma once

#include <string>

namespace whisker::cli {

/// "0.1.0 (1b98848)": the version and the built commit, with "-dirty" if files differ from it; "unknown" if
/// the sources are not in a git repository.
std::string version();

}  // namespace whisker::cli

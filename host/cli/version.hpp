#pragma once

#include <string>

namespace whisker::cli {

/// "0.1.0 (1b98848)": the project's version and the commit that was built, "-dirty" behind it where files
/// differ from that; "unknown" where the sources are no git repository.
std::string version();

}  // namespace whisker::cli

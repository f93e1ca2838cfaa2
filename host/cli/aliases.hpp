/// Former names of commands.
#pragma once

#include <string>
#include <vector>

namespace whisker::cli {

/// The words of the command line without the program, with the present name for a former one.
std::vector<std::string> with_present_names(std::vector<std::string> words);

}  // namespace whisker::cli

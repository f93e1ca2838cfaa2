#pragma once

#include <string>
#include <vector>

#include "host/campaign/row.hpp"

namespace whisker::campaign {

/// The rows of several files written by RowFile, each possibly several files joined (the header may repeat),
/// in any RowFormat. Sorted by world, planner, robot, seed. Throws InputError with file and line for a
/// missing header, a malformed row, a duplicate mission, or files without any row.
std::vector<Row> merged(const std::vector<std::string>& files);

}  // namespace whisker::campaign

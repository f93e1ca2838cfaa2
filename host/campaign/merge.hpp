#pragma once

#include <string>
#include <vector>

#include "host/campaign/row.hpp"

namespace whisker::campaign {

/// The rows of several files as RowFile writes them, each possibly several files one after the other (the
/// header may come again), in any RowFormat. In order of world, planner, robot, seed. Throws InputError with
/// file and line for a missing header, a malformed row, a mission that was there before, or files without any
/// row.
std::vector<Row> merged(const std::vector<std::string>& files);

}  // namespace whisker::campaign

#pragma once

#include <vector>

#include "firmware/params.hpp"
#include "host/scenario/reader.hpp"

namespace whisker {

/// One robot may be told in two tables: a file's top level and its [robot].
using RobotTables = std::vector<TableReader>;

/// Sets the parameters that the tables name, each within its range; relations are not checked. Keys of a
/// table that are no parameters are left alone. Throws InputErrors: every value that is wrong.
void read_robot(const RobotTables& tables, Params& params);

/// Throws InputErrors if the set as a whole is not one that the core accepts: every relation that does not
/// hold, each at a key that it is about, with all of their values and what would mend it.
void check_robot(const RobotTables& tables, const Params& params);

}  // namespace whisker

#pragma once

#include "firmware/params.hpp"
#include "host/scenario/reader.hpp"

namespace whisker {

/// Sets the parameters that the table names, each within its range; relations are not checked.
/// Keys of the table that are no parameters are left alone.
void read_robot(const TableReader& table, Params& params);

/// Throws at the table if the set as a whole is not one that the core accepts.
void check_robot(const TableReader& table, const Params& params);

}  // namespace whisker

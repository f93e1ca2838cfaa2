#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/params.hpp"
#include "host/harness/scenario/reader.hpp"

namespace whisker {

/// A robot may be defined in two tables: the top level of a file and its [robot].
using RobotTables = std::vector<TableReader>;

/// Sets the parameters in the tables, each within its range; relations are not checked. Ignores keys that are
/// not parameters. Throws InputErrors with every wrong value.
void read_robot(const RobotTables& tables, Params& params);

/// The value of this key as the raw value of the parameter at this index of param_list(), within its range.
std::int64_t read_param_value(const TableReader& table, const char* key, std::size_t param);

/// Throws InputErrors if the core refuses the set as a whole: every violated relation, each at one of its
/// keys, with all of their values and the changes that would satisfy it.
void check_robot(const RobotTables& tables, const Params& params);

}  // namespace whisker

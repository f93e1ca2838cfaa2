#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/lab/campaign/row.hpp"

namespace whisker::campaign {

/// A shell command that repeats this mission and draws it.
std::string replay_command(const Row& row);

/// Failed, or off its goal: what failure_lines lists.
bool is_failure(const Row& row);

/// Name for a file of this mission's scenario: "discs-34.toml".
std::string scenario_file(const Row& row);

/// One line for each failed mission, then one for each that is off its goal, with its replay_command; after
/// `most` lines only their counts. Each line ends in a newline; empty if there are none.
std::string failure_lines(const std::vector<Row>& rows, std::size_t most = 20);

}  // namespace whisker::campaign

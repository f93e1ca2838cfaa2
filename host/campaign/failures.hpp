#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/campaign/row.hpp"

namespace whisker::campaign {

/// The command that drives this mission again and draws it, for a shell to take as it is.
std::string replay_command(const Row& row);

/// A line for each mission that did not succeed, then for each that only believes to be there, with its
/// replay_command; after `most` lines only their counts. Each line ends in a newline; empty if nothing was
/// wrong.
std::string failure_lines(const std::vector<Row>& rows, std::size_t most = 20);

}  // namespace whisker::campaign

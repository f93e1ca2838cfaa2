/// Rows as CSV (RFC 4180, lines end in a single newline). docs/campaign.md lists the columns.
#pragma once

#include <string>
#include <string_view>

#include "host/campaign/row.hpp"

namespace whisker::campaign {

/// The header line, without its newline.
extern const char* const kRowHeader;

/// Without a newline. Texts must hold no control characters.
std::string to_csv(const Row& row);

/// Takes exactly what to_csv gives; throws std::invalid_argument that names the first wrong column.
Row parse_row(std::string_view line);

}  // namespace whisker::campaign

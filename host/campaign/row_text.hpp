/// Rows as CSV (RFC 4180, lines end in a single newline). docs/campaign.md lists the columns.
#pragma once

#include <string>
#include <string_view>

#include "host/campaign/row.hpp"

namespace whisker::campaign {

enum class RowFormat {
  judged,    ///< the current format
  believed,  ///< the format without `off_goal`: `reached` is the robot's report, and at_goal says whether it
             ///< is true
};

/// The header line, without its newline.
extern const char* const kRowHeader;
std::string_view row_header(RowFormat format);

/// Without a newline. Texts must hold no control characters.
std::string to_csv(const Row& row);

/// Parses the output of to_csv in that format; throws std::invalid_argument that names the first wrong
/// column.
Row parse_row(std::string_view line, RowFormat format = RowFormat::judged);

}  // namespace whisker::campaign

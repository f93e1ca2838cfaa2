/// Rows as CSV (RFC 4180, lines end in a single newline). docs/campaign.md lists the columns.
#pragma once

#include <string>
#include <string_view>

#include "host/campaign/row.hpp"

namespace whisker::campaign {

enum class RowFormat {
  judged,    ///< today's
  believed,  ///< before `off_goal`: `reached` is the robot's word, and at_goal tells whether it is true
};

/// The header line, without its newline.
extern const char* const kRowHeader;
std::string_view row_header(RowFormat format);

/// Without a newline. Texts must hold no control characters.
std::string to_csv(const Row& row);

/// Takes exactly what to_csv gives, or gave in that format; throws std::invalid_argument that names the first
/// wrong column.
Row parse_row(std::string_view line, RowFormat format = RowFormat::judged);

}  // namespace whisker::campaign

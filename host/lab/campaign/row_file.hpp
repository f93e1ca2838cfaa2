/// A CSV file that grows row by row and always holds complete rows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/harness/file/file.hpp"
#include "host/lab/campaign/row.hpp"

namespace whisker::campaign {

enum class RowFormat {
  numbered,  ///< the current format
  judged,    ///< without the mission's number
  believed,  ///< also without `off_goal`: `reached` is the robot's report, and at_goal says whether it is
             ///< true
};

/// The header line, without its newline.
extern const char* const kRowHeader;
std::string_view row_header(RowFormat format);

/// Without a newline. Texts must hold no control characters.
std::string to_csv(const Row& row);

/// Parses the output of to_csv in that format; throws std::invalid_argument that names the first wrong
/// column.
Row parse_row(std::string_view line, RowFormat format = RowFormat::numbered);

/// Grows by rows as files::Growing grows, so that a campaign goes on where it was stopped: PATH.part always
/// holds complete rows.
class RowFile {
 public:
  /// Writes the header, or reads the rows of PATH.part. Throws also InputError, for a PATH.part that holds
  /// anything else.
  explicit RowFile(const std::string& path);

  const std::vector<Row>& found() const { return found_; }
  /// PATH.part; "" if there is none.
  const std::string& part() const { return file_.part(); }
  void add(const Row& row);
  void finish() { file_.finish(); }

 private:
  files::Growing file_;
  std::vector<Row> found_;
};

/// The rows of several files written by RowFile, each possibly several files joined (the header may repeat),
/// in any RowFormat. Sorted by world, planner, robot, seed. Throws InputError with file and line for a
/// missing header, a malformed row, a duplicate mission, or files without any row, and unless `incomplete`,
/// if missions of a campaign are missing.
std::vector<Row> merged(const std::vector<std::string>& files, bool incomplete = false);

}  // namespace whisker::campaign

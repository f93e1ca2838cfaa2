/// A CSV file that grows row by row and always holds complete rows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/lab/campaign/row.hpp"

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

/// Each row is written to PATH.part in one write; finish() renames it. So PATH is the old file or the
/// complete new one, and the PATH.part of a killed process holds complete rows too. Two writers of one PATH
/// would mix their rows, so the constructor of the second one throws. A device, a pipe, or standard output,
/// "-", is written directly. Errors throw std::runtime_error "cannot write PATH: REASON".
class RowFile {
 public:
  explicit RowFile(const std::string& path);  ///< writes the header
  ~RowFile();                                 ///< without finish(): removes PATH.part
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  void add(const Row& row);
  void finish();

 private:
  void take_part();
  void write_line(std::string_view line);
  [[noreturn]] void fail(int error) const;

  std::string path_;
  std::string target_;
  std::string part_;  ///< empty: written directly, or finished
  int fd_ = -1;
};

/// The rows of several files written by RowFile, each possibly several files joined (the header may repeat),
/// in any RowFormat. Sorted by world, planner, robot, seed. Throws InputError with file and line for a
/// missing header, a malformed row, a duplicate mission, or files without any row.
std::vector<Row> merged(const std::vector<std::string>& files);

}  // namespace whisker::campaign

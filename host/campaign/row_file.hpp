/// A CSV file that grows row by row and is whole at any time.
#pragma once

#include <string>
#include <string_view>

#include "host/campaign/row.hpp"

namespace whisker::campaign {

/// Rows go, each in one write, into PATH.part beside the file; finish() gives it its name. So PATH is the old
/// file or the whole new one, and what a killed process leaves in PATH.part is made of whole rows too.
/// Two that write PATH at a time would mix their rows: the second one's constructor throws. A device or a
/// pipe is written to directly, and so is standard output, "-". Errors throw std::runtime_error "cannot write
/// PATH: REASON".
class RowFile {
 public:
  explicit RowFile(const std::string& path);  ///< writes the header
  ~RowFile();                                 ///< without finish(): leaves no trace
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
  std::string part_;  ///< empty: written to directly, or finished
  int fd_ = -1;
};

}  // namespace whisker::campaign

/// A CSV file that grows row by row and always holds complete rows.
#pragma once

#include <string>
#include <string_view>

#include "host/campaign/row.hpp"

namespace whisker::campaign {

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

}  // namespace whisker::campaign

/// The file of judged cases, one row each. A killed hunt goes on from it, and files of several hunts may be
/// concatenated.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/lab/hunt/robots.hpp"

namespace whisker::hunt {

struct Row {
  std::uint64_t seed = 0;
  std::string parent;  ///< the case of the corpus that was changed with this seed; empty: a fresh draw
  std::string family, world, driver;
  Share families, keys;  ///< draws of the robot
  std::string end, finding;
  double time_s = 0, path_m = 0, gap_m = 0, closeness = 0;
  int work = 0;
  std::uint64_t hash = 0;
};

/// The body touched something, the process died, two computations of the same differ, or a part is not what
/// it says: worse than a robot that stops or errs.
bool harms(const std::string& finding);

std::string to_csv(const Row& row);  ///< with the newline
Row parse_row(const std::string& line);
/// Rows that a kill has cut short, and headers, are skipped.
std::vector<Row> read_rows(const std::vector<std::string>& files);

/// Appends; a row is written at once.
class RowFile {
 public:
  explicit RowFile(const std::string& path);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;
  void add(const Row& row);

 private:
  void write(const std::string& line);
  std::string path_;
  int fd_;
};

/// Cases by finding, accepted draws by family, and the nearest cases. The order of the rows does not matter.
std::string summary(const std::vector<Row>& rows);

}  // namespace whisker::hunt
